// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>

namespace degs {
namespace {

struct ComponentType {
    int gltf; ///< the number in the file
    std::size_t bytes;
    const char* name;
    unsigned plain, normalized; ///< GltfComponents; 0: none
};

constexpr ComponentType kComponentTypes[] = {
    {TINYGLTF_COMPONENT_TYPE_BYTE, 1, "byte", kGltfByte, kGltfByteNormalized},
    {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, 1, "unsigned byte", kGltfUbyte, kGltfUbyteNormalized},
    {TINYGLTF_COMPONENT_TYPE_SHORT, 2, "short", kGltfShort, kGltfShortNormalized},
    {TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, 2, "unsigned short", kGltfUshort,
     kGltfUshortNormalized},
    {TINYGLTF_COMPONENT_TYPE_FLOAT, 4, "float", kGltfFloat, 0},
};

std::string allowed_components(unsigned set) {
    std::string list;
    for (const ComponentType& type : kComponentTypes) {
        if ((set & type.plain) != 0) {
            list += (list.empty() ? "" : ", ") + std::string(type.name);
        }
        if ((set & type.normalized) != 0) {
            list += (list.empty() ? "" : ", ") + std::string("normalized ") + type.name;
        }
    }
    return list;
}

const char* type_name(int width) {
    const char* const names[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    return names[width];
}

int width_of(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    default:
        return 0;
    }
}

const tinygltf::Accessor& accessor_at(const GltfFile& file, int index, const std::string& what) {
    const std::size_t count = file.model.accessors.size();
    if (index < 0 || static_cast<std::size_t>(index) >= count) {
        file.fail(what + " names accessor " + std::to_string(index) + ", and the file has " +
                  std::to_string(count) + ".");
    }
    return file.model.accessors[index];
}

const ComponentType& component_type(const GltfFile& file, const tinygltf::Accessor& accessor,
                                    const GltfAccessorRule& rule) {
    for (const ComponentType& type : kComponentTypes) {
        const unsigned bit = accessor.normalized ? type.normalized : type.plain;
        if (type.gltf == accessor.componentType && (bit & rule.components) != 0) {
            return type;
        }
    }
    file.fail(rule.what + " has components of type " + std::to_string(accessor.componentType) +
              (accessor.normalized ? " (normalized)" : "") + "; allowed are " +
              allowed_components(rule.components) + ".");
}

void check_width(const GltfFile& file, int width, const GltfAccessorRule& rule) {
    if (width < rule.least_width || width > rule.most_width) {
        file.fail(rule.what + " has elements of another type than " + type_name(rule.least_width) +
                  (rule.least_width == rule.most_width
                       ? ""
                       : std::string(" or ") + type_name(rule.most_width)) +
                  ".");
    }
}

/// All comparisons subtract from what is known to be larger, so that no sum can overflow.
void check_range(const GltfFile& file, const tinygltf::Accessor& accessor, const GltfBytes& view,
                 std::size_t element, std::size_t stride, const std::string& what) {
    const bool starts_inside =
        accessor.byteOffset <= view.bytes && element <= view.bytes - accessor.byteOffset;
    if (!starts_inside ||
        accessor.count - 1 > (view.bytes - accessor.byteOffset - element) / stride) {
        file.fail(what + " reaches beyond its buffer view of " + std::to_string(view.bytes) +
                  " bytes: it starts at byte " + std::to_string(accessor.byteOffset) + " and has " +
                  std::to_string(accessor.count) + " elements of " + std::to_string(element) +
                  " bytes, " + std::to_string(stride) + " bytes apart.");
    }
}

/// Where `count` packed items of a sparse accessor lie. tinygltf turns offsets into numbers with a
/// sign.
const unsigned char* packed_items(const GltfFile& file, int view_index, int offset,
                                  std::size_t count, std::size_t item, std::size_t alignment,
                                  const std::string& what) {
    const GltfBytes view = gltf_view(file, view_index, what);
    const std::size_t start = offset < 0 ? view.bytes + 1 : static_cast<std::size_t>(offset);
    if (start > view.bytes || count > (view.bytes - start) / item) {
        file.fail(what + " reach beyond their buffer view of " + std::to_string(view.bytes) +
                  " bytes: they start at byte " + std::to_string(offset) + ", and " +
                  std::to_string(count) + " of " + std::to_string(item) + " bytes are needed.");
    }
    if (view.stride != 0 ||
        (file.model.bufferViews[view_index].byteOffset + start) % alignment != 0) {
        file.fail(what + " must be packed, without a stride, and start at a multiple of " +
                  std::to_string(alignment) + " bytes.");
    }
    return view.data + start;
}

std::size_t index_bytes(const GltfFile& file, int component_type, const std::string& what) {
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return 4;
    default:
        file.fail(what + " have components of type " + std::to_string(component_type) +
                  "; allowed are unsigned byte, unsigned short, unsigned int.");
    }
}

GltfReplacements replacements(const GltfFile& file, const tinygltf::Accessor& accessor,
                              std::size_t element, const std::string& what) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count) {
        file.fail(what + " is sparse and replaces " + std::to_string(sparse.count) + " of its " +
                  std::to_string(accessor.count) + " elements; at least 1 and at most all.");
    }
    GltfReplacements made;
    made.count = static_cast<std::size_t>(sparse.count);
    const std::string indices = what + ": its sparse indices";
    made.index_bytes = index_bytes(file, sparse.indices.componentType, indices);
    made.indices = packed_items(file, sparse.indices.bufferView, sparse.indices.byteOffset,
                                made.count, made.index_bytes, made.index_bytes, indices);
    made.values =
        packed_items(file, sparse.values.bufferView, sparse.values.byteOffset, made.count, element,
                     element / width_of(accessor.type), what + ": its sparse values");
    for (std::size_t i = 0; i < made.count; ++i) {
        if (made.index(i) >= accessor.count || (i > 0 && made.index(i) <= made.index(i - 1))) {
            file.fail(indices + " must increase and be below " + std::to_string(accessor.count) +
                      "; number " + std::to_string(i) + " is " + std::to_string(made.index(i)) +
                      ".");
        }
    }
    return made;
}

template <class From, class To>
void convert(const unsigned char* from, std::size_t stride, std::size_t count, int components,
             double divisor, To* to, std::size_t pitch) {
    for (std::size_t i = 0; i < count; ++i, from += stride, to += pitch) {
        for (int c = 0; c < components; ++c) {
            From value;
            std::memcpy(&value, from + c * sizeof value, sizeof value);
            to[c] = divisor == 0 ? static_cast<To>(value)
                                 : static_cast<To>(std::max(value / divisor, -1.0));
        }
    }
}

} // namespace

std::size_t GltfReplacements::index(std::size_t i) const {
    std::size_t value = 0;
    for (std::size_t byte = index_bytes; byte > 0; --byte) { // little-endian
        value = value << 8 | indices[i * index_bytes + byte - 1];
    }
    return value;
}

GltfBytes gltf_view(const GltfFile& file, int index, const std::string& what) {
    const auto& views = file.model.bufferViews;
    if (index < 0 || static_cast<std::size_t>(index) >= views.size()) {
        file.fail(what + " names buffer view " + std::to_string(index) + ", and the file has " +
                  std::to_string(views.size()) + ".");
    }
    const tinygltf::BufferView& view = views[index];
    const std::string which = "buffer view " + std::to_string(index);
    const auto& buffers = file.model.buffers;
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= buffers.size()) {
        file.fail(which + " names buffer " + std::to_string(view.buffer) + ", and the file has " +
                  std::to_string(buffers.size()) + ".");
    }
    const auto& data = buffers[view.buffer].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
        file.fail(which + " reaches beyond its buffer of " + std::to_string(data.size()) +
                  " bytes: it starts at byte " + std::to_string(view.byteOffset) + " and has " +
                  std::to_string(view.byteLength) + ".");
    }
    return {data.data() + view.byteOffset, view.byteLength, view.byteStride};
}

GltfAccessor::GltfAccessor(const GltfFile& file, int index, const GltfAccessorRule& rule,
                           bool placeholder) {
    const tinygltf::Accessor& accessor = accessor_at(file, index, rule.what);
    count_ = accessor.count;
    width_ = width_of(accessor.type);
    check_width(file, width_, rule);
    if (count_ == 0) {
        file.fail(rule.what + " has no elements; at least one is needed.");
    }
    if (placeholder) {
        return;
    }
    const ComponentType& type = component_type(file, accessor, rule);
    type_ = type.gltf;
    component_bytes_ = type.bytes;
    normalized_ = accessor.normalized;
    if (accessor.sparse.isSparse) {
        sparse_ = replacements(file, accessor, type.bytes * width_, rule.what);
    }
    if (accessor.bufferView == -1) {
        if (!accessor.sparse.isSparse || !rule.may_be_zeros) {
            file.fail(rule.what +
                      " has no buffer view, and there is no compressed data to replace it.");
        }
        return;
    }
    const GltfBytes view = gltf_view(file, accessor.bufferView, rule.what);
    const std::size_t element = type.bytes * width_;
    stride_ = view.stride == 0 ? element : view.stride;
    const std::size_t start =
        file.model.bufferViews[accessor.bufferView].byteOffset + accessor.byteOffset;
    if (stride_ < element || stride_ % type.bytes != 0 || start % type.bytes != 0) {
        file.fail(rule.what + " has elements of " + std::to_string(element) + " bytes that start " +
                  std::to_string(stride_) + " bytes apart at byte " + std::to_string(start) +
                  "; they may not overlap, and components of " + std::to_string(type.bytes) +
                  " bytes start at multiples of that.");
    }
    check_range(file, accessor, view, element, stride_, rule.what);
    data_ = view.data + accessor.byteOffset;
}

template <class To>
void GltfAccessor::read_as(To* to, std::size_t pitch, int components) const {
    const int used = std::min(components, width_);
    const auto convert_from = [&](auto value, double largest) {
        const double divisor = normalized_ ? largest : 0;
        for (std::size_t i = 0; data_ == nullptr && i < count_; ++i) {
            std::fill_n(to + i * pitch, used, To(0));
        }
        convert<decltype(value)>(data_, stride_, data_ == nullptr ? 0 : count_, used, divisor, to,
                                 pitch);
        for (std::size_t i = 0; i < sparse_.count; ++i) {
            convert<decltype(value)>(sparse_.values + i * component_bytes_ * width_, 0, 1, used,
                                     divisor, to + sparse_.index(i) * pitch, pitch);
        }
    };
    switch (type_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return convert_from(std::int8_t{}, 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return convert_from(std::uint8_t{}, 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return convert_from(std::int16_t{}, 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return convert_from(std::uint16_t{}, 65535);
    default:
        return convert_from(float{}, 0);
    }
}

void GltfAccessor::read(float* to, std::size_t pitch, int components) const {
    read_as(to, pitch, components);
}

void GltfAccessor::read(double* to, std::size_t pitch, int components) const {
    read_as(to, pitch, components);
}

} // namespace degs
