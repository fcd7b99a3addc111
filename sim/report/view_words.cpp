// SPDX-License-Identifier: Apache-2.0
#include "sim/report/view_words.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/number_json.hpp"
#include "base/ratio.hpp"
#include "scene/files/image_io.hpp"
#include "sim/report/report.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

/// What a frame or a view takes, as a mean over the run.
struct Share {
    double cycles = 0, bytes_read = 0, bytes_written = 0, energy_nj = 0;
};

Share share_of(const AcceleratorResult& run, std::size_t parts) {
    Share sum;
    for (const StreamUse& stream : run.streams) {
        sum.bytes_read += real_of(stream.bytes_read);
        sum.bytes_written += real_of(stream.bytes_written);
    }
    const double count = real_of(parts);
    return {ratio_of(run.cycles, parts), sum.bytes_read / count, sum.bytes_written / count,
            run.energy.total_nj() / count};
}

ordered_json share_json(const Share& share) {
    return {{"cycles", share.cycles},
            {"bytes_read", share.bytes_read},
            {"bytes_written", share.bytes_written},
            {"energy_nj", share.energy_nj}};
}

ordered_json view_json(const RunResult& result, std::size_t v) {
    const ViewFacts& view = result.views[v];
    const FrameDates& dates = result.accelerator.views[v];
    ordered_json json;
    json["camera"] = camera_json(view.camera);
    json["visible"] = view.workload.visible;
    json["tile_pairs"] = view.workload.tile_pairs;
    json["preprocessing_cycles"] = dates.preprocessed;
    json["finished_cycles"] = dates.finished;
    json["psnr_db"] = view.error ? number_json(view.error->psnr_db) : ordered_json();
    json["ssim"] = view.error ? number_json(view.error->ssim) : ordered_json();
    json["max_abs_error"] = view.error ? number_json(view.error->max_abs_error) : ordered_json();
    json["crc32"] = pixel_crc32(result.accelerator.images[v]);
    return json;
}

} // namespace

ordered_json views_json(const RunResult& result) {
    const AcceleratorResult& run = result.accelerator;
    ordered_json json;
    json["count"] = result.views.size();
    json["shared"] = name_of(result.config.accelerator().view_sharing());
    json["per_frame"] = share_json(share_of(run, run.frames.size()));
    json["per_view"] = share_json(share_of(run, run.views.size()));
    json["first_frame"] = ordered_json::array();
    for (std::size_t v = 0; v < result.views.size(); ++v) {
        json["first_frame"].push_back(view_json(result, v));
    }
    return json;
}

std::string views_words(const RunResult& result) {
    constexpr double kMjPerNj = 1e-6;
    const AcceleratorResult& run = result.accelerator;
    const Share view = share_of(run, run.views.size());
    const auto bytes = static_cast<std::uint64_t>(view.bytes_read + view.bytes_written);
    std::string words = std::to_string(result.views.size()) + " per frame, shared: " +
                        name_of(result.config.accelerator().view_sharing()) + " · each " +
                        scaled(view.cycles) + " cycles, " + scaled_bytes(bytes) + ", " +
                        three_digits(view.energy_nj * kMjPerNj) + " mJ";
    for (std::size_t v = 1; v < images_of(result) && error_of(result, v); ++v) {
        const ImageError& error = *error_of(result, v);
        words += " · image-" + std::to_string(v) + " " +
                 (error.max_abs_error == 0 ? "identical" : three_digits(error.psnr_db) + " dB");
    }
    return words;
}

} // namespace degs::sim
