// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_primitive.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "scene/files/axes.hpp"
#include "scene/gltf/gltf_accessor.hpp"
#include "scene/spz/spz.hpp"
#include "splat/model/spherical_harmonics.hpp"

namespace degs {
namespace {

constexpr const char* kSplats = "KHR_gaussian_splatting";
constexpr const char* kDraftCompression =
    "KHR_spz_gaussian_splats_compression"; ///< of the primitive
constexpr const char* kCompressions[] = {"KHR_gaussian_splatting_compression_spz_2",
                                         "KHR_gaussian_splatting_compression_spz"};
constexpr const char* kGltfAxes = "LUF"; ///< what the draft wants SPZ data turned to

constexpr unsigned kUnsignedNormalized = kGltfUbyteNormalized | kGltfUshortNormalized;
constexpr unsigned kSignedNormalized = kGltfByteNormalized | kGltfShortNormalized;
constexpr unsigned kQuantized =
    kGltfByte | kGltfUbyte | kGltfShort | kGltfUshort | kUnsignedNormalized | kSignedNormalized;

/// The value of `property` if it is one of `known`; other ones are noted.
void check_property(GltfFile& file, const tinygltf::Value& extension, const char* property,
                    bool required, std::initializer_list<const char*> known) {
    const tinygltf::Value* const value = member_of(extension, property);
    const std::string fallback = std::string("'") + *known.begin() + "'";
    if (value == nullptr) {
        if (required) {
            file.note(std::string("KHR_gaussian_splatting has no '") + property +
                      "', as in drafts of 2025; it is taken as " + fallback + ".");
        }
        return;
    }
    const std::string text = value->IsString() ? value->Get<std::string>() : "";
    if (std::find(known.begin(), known.end(), text) == known.end()) {
        file.note(std::string("The ") + property + " " + (text.empty() ? "''" : quoted_name(text)) +
                  " of KHR_gaussian_splatting is not known; it is taken as " + fallback + ".");
    }
}

void check_extension(GltfFile& file, const tinygltf::Value& extension) {
    check_property(file, extension, "kernel", true, {"ellipse"});
    check_property(file, extension, "colorSpace", true,
                   {"srgb_rec709_display", "lin_rec709_display", "BT.709-sRGB"});
    check_property(file, extension, "projection", false, {"perspective"});
    check_property(file, extension, "sortingMethod", false, {"cameraDistance"});
    const tinygltf::Value* const space = member_of(extension, "colorSpace");
    if (space != nullptr && space->IsString() &&
        space->Get<std::string>() == "lin_rec709_display") {
        file.note(kLinearColoursNote);
    }
}

class PrimitiveReader {
public:
    PrimitiveReader(GltfFile& file, std::size_t mesh, std::size_t primitive)
        : file_(file), primitive_(file.model.meshes[mesh].primitives[primitive]),
          where_("mesh " + std::to_string(mesh) + ", primitive " + std::to_string(primitive)) {}

    SplatPrimitive read() {
        check_drawing();
        const auto extension = primitive_.extensions.find(kSplats);
        if (extension != primitive_.extensions.end()) {
            check_extension(file_, extension->second);
        }
        if (const tinygltf::Value* const compression = find_compression()) {
            return decompress(*compression);
        }
        count_ = accessor("POSITION", "POSITION", 3, 3, position_components()).count();
        find_sh_degree();
        read_shape();
        read_colours();
        return {std::move(cloud_), false, false, false};
    }

private:
    void check_drawing() {
        if (primitive_.mode != TINYGLTF_MODE_POINTS) {
            file_.fail(where_ + " has splats and mode " + std::to_string(primitive_.mode) +
                       "; mode 0 (POINTS) is needed.");
        }
        if (primitive_.indices != -1) {
            file_.fail(where_ + " has splats and indices, which splats may not have.");
        }
    }

    /// The extension with the SPZ data; nullptr if the attributes have data of their own.
    const tinygltf::Value* find_compression() const {
        const auto draft = primitive_.extensions.find(kDraftCompression);
        if (draft != primitive_.extensions.end()) {
            return &draft->second;
        }
        const auto extension = primitive_.extensions.find(kSplats);
        const tinygltf::Value* const nested = member_of(extension->second, "extensions");
        if (nested == nullptr || !nested->IsObject() || nested->Keys().empty()) {
            return nullptr;
        }
        for (const char* const name : kCompressions) {
            if (const tinygltf::Value* const found = member_of(*nested, name)) {
                return found;
            }
        }
        file_.fail(where_ + " has splats with the extension " + quoted_name(nested->Keys()[0]) +
                   ", which is not read.");
    }

    SplatPrimitive decompress(const tinygltf::Value& extension) {
        const tinygltf::Value* const view = member_of(extension, "bufferView");
        const GltfBytes bytes =
            gltf_view(file_, view != nullptr && view->IsInt() ? view->GetNumberAsInt() : -1,
                      where_ + ": its SPZ data");
        SceneContent content = decode_spz(file_.path + ": " + where_ + ": its SPZ data",
                                          {reinterpret_cast<const char*>(bytes.data), bytes.bytes});
        for (const std::string& note : content.notes) {
            file_.note(note);
        }
        for (const auto& [name, index] : primitive_.attributes) {
            const std::size_t count =
                GltfAccessor(file_, index, {where_ + ": " + quoted_name(name), 1, 4, 0}, true)
                    .count();
            if (count != content.cloud.size()) {
                file_.fail(where_ + ": " + quoted_name(name) + " has " + std::to_string(count) +
                           " elements, and the SPZ data has " +
                           std::to_string(content.cloud.size()) + " splats.");
            }
        }
        convert_axes(content.cloud, content.axes, *parse_axes(kGltfAxes));
        return {std::move(content.cloud), true, content.axes_assumed, content.traits.antialiased};
    }

    unsigned position_components() const {
        const auto& used = file_.model.extensionsUsed;
        const bool quantized =
            std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
        return quantized ? kGltfFloat | kQuantized : unsigned{kGltfFloat};
    }

    /// The name under which the primitive has an attribute; drafts of 2025 wrote _SCALE and so on.
    std::optional<std::string> name_of(const std::string& attribute) {
        const auto& attributes = primitive_.attributes;
        const std::string name = std::string(kSplats) + ":" + attribute;
        if (attributes.count(name) != 0) {
            return name;
        }
        if (attributes.count("_" + attribute) == 0) {
            return std::nullopt;
        }
        file_.note("Attributes are named as in drafts of 2025, e.g. '_" + attribute + "'.");
        return "_" + attribute;
    }

    std::string required(const std::string& attribute) {
        if (const std::optional<std::string> name = name_of(attribute)) {
            return *name;
        }
        file_.fail(where_ + " has no attribute '" + kSplats + ":" + attribute +
                   "', which splats need.");
    }

    /// The accessor of an attribute that the primitive has under `name`.
    GltfAccessor accessor(const std::string& name, const std::string& attribute, int least,
                          int most, unsigned components) {
        const auto found = primitive_.attributes.find(name);
        if (found == primitive_.attributes.end()) {
            file_.fail(where_ + " has no attribute '" + name + "', which splats need.");
        }
        const std::string what = where_ + ": " + attribute;
        // POSITION, which comes first, says how many there are.
        const GltfAccessor made(file_, found->second, {what, least, most, components, count_ != 0});
        if (count_ != 0 && made.count() != count_) {
            file_.fail(what + " has " + std::to_string(made.count()) +
                       " elements, and POSITION has " + std::to_string(count_) + ".");
        }
        return made;
    }

    GltfAccessor splat_accessor(const std::string& attribute, int width, unsigned components) {
        return accessor(required(attribute), attribute, width, width, components);
    }

    static std::string sh_name(int degree, int n) {
        return "SH_DEGREE_" + std::to_string(degree) + "_COEF_" + std::to_string(n);
    }

    /// A degree is complete or absent, and has all lower ones below it.
    void find_sh_degree() {
        for (int degree = 1; degree <= kMaxShDegree; ++degree) {
            int present = 0;
            for (int n = 0; n <= 2 * degree; ++n) {
                present += name_of(sh_name(degree, n)) ? 1 : 0;
            }
            if (present == 0) {
                continue;
            }
            if (present != 2 * degree + 1 || cloud_.sh_degree != degree - 1) {
                file_.fail(where_ + " has " + std::to_string(present) + " of the " +
                           std::to_string(2 * degree + 1) + " coefficients of SH degree " +
                           std::to_string(degree) + " and all of degree " +
                           std::to_string(cloud_.sh_degree) +
                           "; a degree is complete or absent, and so are those below it.");
            }
            cloud_.sh_degree = degree;
        }
        if (name_of(sh_name(kMaxShDegree + 1, 0))) {
            file_.note("SH coefficients above degree 3 are ignored.");
        }
    }

    void read_shape() {
        cloud_.means.resize(count_);
        cloud_.rotations.resize(count_);
        cloud_.scales.resize(count_);
        cloud_.opacities.resize(count_);
        accessor("POSITION", "POSITION", 3, 3, position_components())
            .read(&cloud_.means[0].x, 3, 3);
        splat_accessor("ROTATION", 4, kGltfFloat | kSignedNormalized)
            .read(&cloud_.rotations[0].x, 4, 4);
        for (glm::vec4& q : cloud_.rotations) { // x y z w in the file
            q = glm::vec4(q.w, q.x, q.y, q.z);
        }
        splat_accessor("SCALE", 3, kGltfFloat | kGltfUbyte | kGltfUshort | kUnsignedNormalized)
            .read(&cloud_.scales[0].x, 3, 3);
    }

    void read_colours() {
        cloud_.sh.resize(count_ * cloud_.sh_coefficients() * 3);
        const bool has_colour = name_of(sh_name(0, 0)).has_value();
        const bool has_opacity = name_of("OPACITY").has_value();
        const bool has_fallback = primitive_.attributes.count("COLOR_0") != 0;
        if (has_opacity || !has_fallback) {
            splat_accessor("OPACITY", 1, kGltfFloat | kUnsignedNormalized)
                .read(cloud_.opacities.data(), 1, 1);
        }
        for (int degree = has_colour || !has_fallback ? 0 : 1; degree <= cloud_.sh_degree;
             ++degree) {
            for (int n = 0; n <= 2 * degree; ++n) {
                splat_accessor(sh_name(degree, n), 3, kGltfFloat)
                    .read(cloud_.sh.data() + (degree * degree + n) * 3,
                          cloud_.sh_coefficients() * 3, 3);
            }
        }
        if (has_fallback && !(has_colour && has_opacity)) {
            read_fallback(!has_colour, !has_opacity);
        }
    }

    /// Drafts of 2025 had no attributes for opacity and SH degree 0: COLOR_0 was both.
    void read_fallback(bool colour, bool opacity) {
        const GltfAccessor color =
            accessor("COLOR_0", "COLOR_0", opacity ? 4 : 3, 4, kGltfFloat | kUnsignedNormalized);
        file_.note(std::string(colour && opacity ? "Colour and opacity are"
                               : colour          ? "The colour is"
                                                 : "The opacity is") +
                   " taken from COLOR_0, as in drafts of 2025, because the attributes of "
                   "KHR_gaussian_splatting are missing.");
        std::vector<glm::vec4> values(count_);
        color.read(&values[0].x, 4, 4);
        const std::size_t pitch = cloud_.sh_coefficients() * 3;
        for (std::size_t i = 0; i < count_; ++i) {
            for (int channel = 0; colour && channel < 3; ++channel) {
                cloud_.sh[i * pitch + channel] =
                    static_cast<float>((double{values[i][channel]} - 0.5) / kShY0);
            }
            cloud_.opacities[i] = opacity ? values[i].w : cloud_.opacities[i];
        }
    }

    GltfFile& file_;
    const tinygltf::Primitive& primitive_;
    std::string where_;
    std::size_t count_ = 0;
    GaussianCloud cloud_;
};

} // namespace

bool is_splat_primitive(const tinygltf::Primitive& primitive) {
    return primitive.extensions.count(kSplats) != 0 ||
           primitive.extensions.count(kDraftCompression) != 0;
}

SplatPrimitive read_splat_primitive(GltfFile& file, std::size_t mesh, std::size_t primitive) {
    return PrimitiveReader(file, mesh, primitive).read();
}

} // namespace degs
