// SPDX-License-Identifier: Apache-2.0
#include "scene/npz/npz.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "scene/archive/zip_archive.hpp"
#include "scene/files/activation_scan.hpp"
#include "scene/files/input_file.hpp"
#include "scene/npz/nearest_points.hpp"
#include "scene/npz/npy_array.hpp"
#include "scene/npz/npz_cameras.hpp"
#include "splat/model/spherical_harmonics.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kMaxArrayBytes = std::uint64_t{1} << 36;
constexpr double kStartOpacity = 0.1;  ///< of the original code
constexpr double kLeastSquared = 1e-7; ///< of the original code, squared scene units
constexpr std::uint64_t kMaxPoints = 1U << 31;

class NpzReader {
public:
    explicit NpzReader(const std::string& path) : archive_(path) {}

    SceneContent read() {
        refuse_dynamic();
        const std::optional<NpyArray> means = any({"means", "means3d", "points"});
        if (!means) {
            fail_file(archive_.path(), "the archive holds no array 'means', 'means3d' or 'points'; "
                                       "this is no scene.");
        }
        if (means->shape.size() != 2 || means->shape[1] != 3 || means->shape[0] == 0 ||
            means->shape[0] >= kMaxPoints) {
            refuse(*means, "of the positions", "(N, 3)");
        }
        count_ = means->shape[0];
        for (std::uint64_t i = 0; i < count_; ++i) {
            cloud().means.emplace_back(means->at(3 * i), means->at(3 * i + 1),
                                       means->at(3 * i + 2));
        }
        archive_.has("scales.npy") ? read_gaussians() : start_from_points();
        content_.cameras = read_npz_cameras(archive_);
        return std::move(content_);
    }

private:
    GaussianCloud& cloud() { return content_.cloud; }

    void refuse_dynamic() const {
        if (archive_.has("unnorm_rotations.npy") || archive_.has("means3D.npy")) {
            fail_file(archive_.path(), "this is a dynamic scene (Dynamic3DGaussians), which is not "
                                       "supported; export one file per frame.");
        }
    }

    std::optional<NpyArray> any(std::initializer_list<const char*> names) const {
        for (const char* const name : names) {
            const std::string file = std::string(name) + ".npy";
            if (archive_.has(file)) {
                return parse_npy(archive_.path(), name, archive_.read(file, kMaxArrayBytes));
            }
        }
        return std::nullopt;
    }

    [[noreturn]] void refuse(const NpyArray& array, const std::string& what,
                             const std::string& shape) const {
        fail_file(archive_.path(), "the array " + what + " has the shape " + array.shape_words() +
                                       ", but " + shape + " is needed.");
    }

    /// An array of `each` numbers per Gaussian, with any division into axes behind the first.
    NpyArray require(const char* name, std::uint64_t each) const {
        std::optional<NpyArray> array = any({name});
        if (!array) {
            fail_file(archive_.path(), std::string("the archive holds no array '") + name +
                                           "', which its Gaussians need.");
        }
        if (array->shape.empty() || array->shape[0] != count_ || array->size() != each * count_) {
            refuse(*array, std::string("'") + name + "'",
                   each == 1
                       ? "(N) with N = " + std::to_string(count_)
                       : "(N, " + std::to_string(each) + ") with N = " + std::to_string(count_));
        }
        return *std::move(array);
    }

    void read_gaussians() {
        const NpyArray quats = require("quats", 4);
        for (std::uint64_t i = 0; i < count_; ++i) {
            cloud().rotations.emplace_back(quats.at(4 * i), quats.at(4 * i + 1),
                                           quats.at(4 * i + 2), quats.at(4 * i + 3));
        }
        read_scales_and_opacities();
        archive_.has("sh0.npy") ? read_sh0() : read_colors();
    }

    void read_scales_and_opacities() {
        const NpyArray scales = require("scales", 3), opacities = require("opacities", 1);
        ActivationScan scan;
        for (std::uint64_t i = 0; i < scales.size() && scan.scales_look_activated(); ++i) {
            scan.add_scale(scales.at(i));
        }
        for (std::uint64_t i = 0; i < count_ && scan.opacities_look_activated(); ++i) {
            scan.add_opacity(opacities.at(i));
        }
        bool as_scales = scan.scales_look_activated();
        bool as_opacities = scan.opacities_look_activated();
        std::string note = taken_as_they_are_note(as_scales, as_opacities);
        if (as_scales != as_opacities && count_ < kFewestToTake) {
            as_scales = as_opacities = false;
            note.clear();
        }
        for (std::uint64_t i = 0; i < count_; ++i) {
            const glm::dvec3 s(scales.at(3 * i), scales.at(3 * i + 1), scales.at(3 * i + 2));
            const double o = opacities.at(i);
            cloud().scales.emplace_back(as_scales ? s : glm::exp(s));
            cloud().opacities.push_back(
                static_cast<float>(as_opacities ? o : 1 / (1 + std::exp(-o))));
        }
        if (!as_scales && !as_opacities) {
            note = activated_note(scan, cloud());
        }
        if (!note.empty()) {
            content_.notes.push_back(std::move(note));
        }
    }

    /// Degree 0 to 3 of `coefficients`, of which those of degree 4 are dropped.
    void choose_degree(std::uint64_t coefficients) {
        for (int degree = 0; degree <= 4; ++degree) {
            if (coefficients == std::uint64_t{1} * (degree + 1) * (degree + 1)) {
                cloud().sh_degree = std::min(degree, 3);
                if (degree == 4) {
                    content_.notes.emplace_back("The spherical harmonics of degree 4 were dropped, "
                                                "because images are drawn with degree 3 at most.");
                }
                cloud().sh.resize(count_ * cloud().sh_coefficients() * 3);
                return;
            }
        }
        fail_file(archive_.path(), "its Gaussians have " + std::to_string(coefficients) +
                                       " coefficients of spherical harmonics per channel; allowed "
                                       "are 1, 4, 9, 16 and 25.");
    }

    /// Copies coefficients (N, K, 3), which become those from `first` on.
    void copy_sh(const NpyArray& array, int first) {
        const std::uint64_t each = array.size() / count_;
        const std::uint64_t pitch = cloud().sh_coefficients() * 3;
        const std::uint64_t used = std::min<std::uint64_t>(each, pitch - 3 * first);
        for (std::uint64_t i = 0; i < count_; ++i) {
            for (std::uint64_t k = 0; k < used; ++k) {
                cloud().sh[i * pitch + 3 * first + k] = static_cast<float>(array.at(i * each + k));
            }
        }
    }

    void read_sh0() {
        const NpyArray sh0 = require("sh0", 3);
        const std::optional<NpyArray> rest = any({"shN"});
        if (rest && (rest->shape.size() != 3 || rest->shape[0] != count_ || rest->shape[2] != 3)) {
            refuse(*rest, "'shN'", "(N, K, 3)");
        }
        choose_degree(1 + (rest ? rest->shape[1] : 0));
        copy_sh(sh0, 0);
        if (rest && rest->size() > 0) {
            copy_sh(*rest, 1);
        }
    }

    void read_colors() {
        const std::optional<NpyArray> colors = any({"colors"});
        if (!colors || colors->shape.size() != 3 || colors->shape[0] != count_ ||
            colors->shape[2] != 3) {
            fail_file(archive_.path(),
                      "its Gaussians need the array 'sh0' (N, 1, 3) with 'shN', or "
                      "'colors' (N, K, 3).");
        }
        choose_degree(colors->shape[1]);
        copy_sh(*colors, 0);
    }

    void start_from_points() {
        const std::optional<NpyArray> colors = any({"colors", "rgb", "points_rgb"});
        if (!colors || colors->shape.size() != 2 || colors->shape[0] != count_ ||
            colors->shape[1] != 3) {
            fail_file(archive_.path(), "the archive holds neither the scales of Gaussians nor the "
                                       "colours (N, 3) of points.");
        }
        for (const glm::dvec3& mean : cloud().means) {
            if (!std::isfinite(mean.x + mean.y + mean.z)) {
                fail_file(archive_.path(), "a position of its points is not finite.");
            }
        }
        content_.notes.emplace_back(
            "The file holds points, not Gaussians; they were started as the original 3DGS code "
            "does: "
            "round, as wide as the mean distance to the 3 nearest, of opacity 0.1.");
        const double full = colors->kind == 'f' ? 1 : 255;
        const std::vector<double> squared = mean_squared_distances(cloud().means);
        for (std::uint64_t i = 0; i < count_; ++i) {
            cloud().scales.emplace_back(
                static_cast<float>(std::sqrt(std::max(squared[i], kLeastSquared))));
            cloud().rotations.emplace_back(1, 0, 0, 0);
            cloud().opacities.push_back(static_cast<float>(kStartOpacity));
            for (int channel = 0; channel < 3; ++channel) {
                cloud().sh.push_back(
                    static_cast<float>((colors->at(3 * i + channel) / full - 0.5) / kShY0));
            }
        }
    }

    ZipArchive archive_;
    std::uint64_t count_ = 0;
    SceneContent content_;
};

} // namespace

SceneContent read_npz(const std::string& path) {
    return NpzReader(path).read();
}

} // namespace degs
