// SPDX-License-Identifier: Apache-2.0
// degs soc: the accelerator on a platform where others use the memory as well.
#include <memory>
#include <utility>

#include <nlohmann/json.hpp>

#include "config/config_source.hpp"
#include "degs/error.hpp"
#include "degs/request_info.hpp"
#include "sim/design/run_config.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/soc/platform_keys.hpp"
#include "sim/soc/soc_study.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"
#include "sim/trace/trace_options.hpp"
#include "sim/view/view.hpp"
#include "sim/view/view_group.hpp"
#include "splat/frame/projection.hpp"

namespace degs::sim {
namespace {

struct SocOptions {
    std::string config;
    std::vector<std::string> accelerators; // behind that of `config`, if there is one
    std::vector<unsigned> qos;             // of all of them
    std::vector<double> rates;
    int frames = 0; // 0: not said
    double deadline_ms = 0;
    unsigned cores_qos = 0, display_qos = 0;
    std::vector<std::string> overrides;
    std::string memory;
    ViewRequest view;
    GroupRequest group;
    std::vector<double> loads;
    int cores = 4;
    std::string pattern = "stream";
    int reads_per_write = 2;
    double refresh_hz = 60;
    std::string out = "out";
    TraceRequest trace;
};

/// Without a word about loads: none, then eighths of the peak up to three quarters.
std::vector<double> loads_of(const SocOptions& options, double peak_gb_per_s) {
    if (!options.loads.empty()) {
        return options.loads;
    }
    std::vector<double> loads;
    for (int eighth = 0; eighth <= 6; ++eighth) {
        loads.push_back(peak_gb_per_s * eighth / 8);
    }
    return loads;
}

/// All accelerators; `--set` is for the first.
std::vector<SocAccelerator> accelerators_of(const SocOptions& options) {
    std::vector<std::string> files = options.accelerators;
    if (!options.config.empty()) {
        files.insert(files.begin(), options.config);
    }
    if (files.empty()) {
        throw InputError("There is no accelerator: name a configuration file, as "
                         "configs/degs-64.yaml.");
    }
    if (options.qos.size() > files.size()) {
        throw InputError("--qos has " + std::to_string(options.qos.size()) +
                         " levels, but there are " + std::to_string(files.size()) +
                         " accelerators; it takes at most one for each.");
    }
    const GroupRequest& group = options.group;
    std::vector<SocAccelerator> accelerators;
    for (const std::string& file : files) {
        const bool first = accelerators.empty();
        const ConfigSource source =
            ConfigSource::from_file(file, first ? options.overrides : std::vector<std::string>());
        RunConfig config = load_run_config(source);
        print_warnings(
            check_platform_keys(source, config, group.images() > 1 || group.foveation.has_value()));
        const std::size_t i = accelerators.size();
        accelerators.push_back({std::move(config), i < options.qos.size() ? options.qos[i] : 0U});
    }
    return accelerators;
}

/// Cores, display and other accelerators.
void put_competition(const SocOptions& options, SocRequest& request) {
    const bool others = request.accelerators.size() > 1;
    request.loads = others && options.loads.empty()
                        ? std::vector<double>{0}
                        : loads_of(options, request.memory.peak_gb_per_s());
    if (others) {
        request.rates =
            options.rates.empty() ? std::vector<double>{0, 60, 120, 240, 480, 960} : options.rates;
    } else if (!options.rates.empty()) {
        throw InputError("--rate is how many frames per second the other accelerators begin, but "
                         "there are none; --accelerator adds one.");
    }
    request.frames = options.frames > 0 ? options.frames : others ? 4 : 1;
    request.cores = options.cores;
    request.cores_qos = options.cores_qos;
    request.pattern =
        options.pattern == "stream" ? CpuTraffic::Pattern::Stream : CpuTraffic::Pattern::Random;
    request.reads_per_write = options.reads_per_write;
    request.refresh_hz = options.refresh_hz;
    request.display_qos = options.display_qos;
    request.deadline_ms = options.deadline_ms > 0  ? options.deadline_ms
                          : options.refresh_hz > 0 ? 1000 / options.refresh_hz
                                                   : 0;
}

/// The images of a frame. Throws InputError for a lens that the design cannot draw.
void put_images(const SocOptions& options, View& view, SocRequest& request) {
    const std::vector<Camera> cameras = cameras_of_frame(options.view, options.group, view.scene);
    for (const SocAccelerator& accelerator : request.accelerators) {
        const ProjectionOptions projection = projection_of(
            accelerator.config.accelerator().data_path(), view.scene.traits.antialiased);
        for (const Camera& camera : cameras) {
            check_projection(camera, projection);
        }
    }
    view.camera = cameras.front();
    request.foveation = options.group.foveation;
    request.images = images_of(cameras, request.foveation);
}

void run(const SocOptions& options) {
    SocRequest request;
    request.accelerators = accelerators_of(options);
    if (!options.memory.empty()) {
        ConfigSource::from_file(options.memory).load(request.memory);
    }
    put_competition(options, request);
    View view = load_view(options.view);
    print_warnings(view.scene.notes);
    put_images(options, view, request);
    const OutputFolder out(options.out, {"soc.json", "soc.svg"});
    request.timeline = timeline_of(options.trace);
    const SocResult result = run_soc(request, view);
    print_warnings(result.warnings);
    out.replace([&] {
        const AcceleratorConfig& config = request.config().accelerator();
        out.write_json("soc.json", soc_json(request, view, result));
        out.write_text("soc.svg", soc_svg(config.name + ": frame latency under competing traffic",
                                          result.points));
        if (request.timeline) {
            write_trace({config.name, config.clock_ghz, result.timeline, result.frames},
                        options.trace.file);
        }
    });
    print(soc_words(request, view, result));
}

void add_accelerator_options(CLI::App& command, SocOptions& options) {
    command
        .add_option("--accelerator", options.accelerators,
                    "configuration file of another accelerator, which draws the same views while "
                    "the first one is measured; may be repeated")
        ->type_name("FILE");
    command
        .add_option("--rate", options.rates,
                    "frames per second that each other accelerator begins, measured one after the "
                    "other; default: 0 60 120 240 480 960")
        ->check(CLI::Range(0.0, 1e9));
    command
        .add_option("--qos", options.qos,
                    "levels of the accelerators' accesses, 0 to 15, in their order; the memory "
                    "lets reads of a higher one go first; default: 0")
        ->check(CLI::Range(0U, RequestInfo::kMostQos));
    command
        .add_option("--frames", options.frames,
                    "frames for each load and rate; default: 1, with other accelerators 4")
        ->check(CLI::Range(1, 10000));
    command
        .add_option("--deadline", options.deadline_ms,
                    "ms; longer frames are counted as late; default: the display's period")
        ->check(CLI::Range(1e-6, 1e6));
}

void add_traffic_options(CLI::App& command, SocOptions& options) {
    command
        .add_option("--load", options.loads,
                    "GB/s that all cores together ask for, measured one after the other; default: "
                    "eighths of the peak, 0 to 6, with other accelerators 0")
        ->check(CLI::Range(0.0, 1e4));
    command.add_option("--cores", options.cores, "cores that make traffic")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    command
        .add_option("--pattern", options.pattern, "addresses of a core: stream, or random lines")
        ->check(CLI::IsMember({"stream", "random"}))
        ->capture_default_str();
    command
        .add_option("--reads-per-write", options.reads_per_write,
                    "reads of a core per write, on average; 0: reads only")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command
        .add_option("--refresh", options.refresh_hz,
                    "pictures per second of the display; 0: no display")
        ->check(CLI::Range(0.0, 1000.0))
        ->capture_default_str();
    command.add_option("--cores-qos", options.cores_qos, "level of the cores' accesses, 0 to 15")
        ->check(CLI::Range(0U, RequestInfo::kMostQos))
        ->capture_default_str();
    command
        .add_option("--display-qos", options.display_qos,
                    "level of the display's accesses, 0 to 15")
        ->check(CLI::Range(0U, RequestInfo::kMostQos))
        ->capture_default_str();
}

} // namespace

void add_soc_command(CLI::App& program) {
    auto options = std::make_shared<SocOptions>();
    CLI::App* command = program.add_subcommand(
        "soc", "run accelerators on a platform with cores and a display that use the memory");
    add_config_option(*command, options->config);
    add_view_options(*command, options->view);
    add_group_options(*command, options->group);
    add_foveation_option(*command, options->group);
    command
        ->add_option("--memory", options->memory,
                     "configuration file of the platform's memory (configs/memory/*.yaml); "
                     "default: LPDDR5-6400 of 256 bit")
        ->type_name("FILE");
    add_accelerator_options(*command, *options);
    add_traffic_options(*command, *options);
    add_out_option(*command, options->out, "folder for soc.json and soc.svg");
    add_trace_options(*command, options->trace);
    add_overrides_option(*command, options->overrides);
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
