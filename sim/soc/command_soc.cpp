// SPDX-License-Identifier: Apache-2.0
// degs soc: the accelerator on a platform where others use the memory as well.
#include <memory>

#include <nlohmann/json.hpp>

#include "config/config_source.hpp"
#include "degs/error.hpp"
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

RunConfig soc_config(const SocOptions& options, dram::Config& memory) {
    const ConfigSource source = ConfigSource::from_file(options.config, options.overrides);
    RunConfig config = load_run_config(source);
    const GroupRequest& group = options.group;
    print_warnings(
        check_platform_keys(source, config, group.images() > 1 || group.foveation.has_value()));
    if (!options.memory.empty()) {
        ConfigSource::from_file(options.memory).load(memory);
    }
    return config;
}

/// The images of a frame. Throws InputError for a lens that the design cannot draw.
void put_images(const SocOptions& options, View& view, SocRequest& request) {
    const std::vector<Camera> cameras = cameras_of_frame(options.view, options.group, view.scene);
    const AcceleratorConfig& config = request.config.accelerator();
    for (const Camera& camera : cameras) {
        check_projection(camera, projection_of(config.data_path(), view.scene.traits.antialiased));
    }
    view.camera = cameras.front();
    request.foveation = options.group.foveation;
    request.images = images_of(cameras, request.foveation);
}

void run(const SocOptions& options) {
    SocRequest request;
    request.config = soc_config(options, request.memory);
    request.loads = loads_of(options, request.memory.peak_gb_per_s());
    request.cores = options.cores;
    request.pattern =
        options.pattern == "stream" ? CpuTraffic::Pattern::Stream : CpuTraffic::Pattern::Random;
    request.reads_per_write = options.reads_per_write;
    request.refresh_hz = options.refresh_hz;
    View view = load_view(options.view);
    print_warnings(view.scene.notes);
    put_images(options, view, request);
    const OutputFolder out(options.out, {"soc.json", "soc.svg"});
    request.timeline = timeline_of(options.trace);
    const SocResult result = run_soc(request, view);
    print_warnings(result.warnings);
    out.replace([&] {
        const AcceleratorConfig& config = request.config.accelerator();
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

void add_traffic_options(CLI::App& command, SocOptions& options) {
    command
        .add_option("--load", options.loads,
                    "GB/s that all cores together ask for, one frame each; default: eighths of the "
                    "peak, 0 to 6")
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
}

} // namespace

void add_soc_command(CLI::App& program) {
    auto options = std::make_shared<SocOptions>();
    CLI::App* command = program.add_subcommand(
        "soc", "run the accelerator on a platform with cores and a display that use the memory");
    add_config_option(*command, options->config)->required();
    add_view_options(*command, options->view);
    add_group_options(*command, options->group);
    add_foveation_option(*command, options->group);
    command
        ->add_option("--memory", options->memory,
                     "configuration file of the platform's memory (configs/memory/*.yaml); "
                     "default: LPDDR5-6400 of 256 bit")
        ->type_name("FILE");
    add_traffic_options(*command, *options);
    add_out_option(*command, options->out, "folder for soc.json and soc.svg");
    add_trace_options(*command, options->trace);
    add_overrides_option(*command, options->overrides);
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
