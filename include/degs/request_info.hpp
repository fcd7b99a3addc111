// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tlm>

namespace degs {

/// The kind of traffic that a transaction belongs to, a number that an IOMMU may check. Reports
/// have the same streams by name, see to_string().
enum class RequestStream : std::uint32_t {
    Other = 0, ///< of an accelerator of one's own, whose stream has another name
    SceneLoad = 1,
    Geometry = 2,
    Sh = 3,
    SplatsWritten = 4,
    SplatsRead = 5,
    TileListsWritten = 6,
    TileListsSorted = 7,
    ListHeads = 8,
    FrameBuffer = 9,
    Means = 10,
    Shapes = 11,
    GroupListsWritten = 12,
    GroupListsRead = 13,
};

/// The name of a stream in reports: "tile_lists_written".
const char* to_string(RequestStream stream);
/// The stream of a name; Other if there is none.
RequestStream request_stream(const char* name);

/// What degs::Accelerator says of each of its transactions, beside the generic payload; targets
/// that do not know it may ignore it. It lives as long as the transaction: in b_transport() until
/// the call returns, in four phases until the last reference is released. A target that needs it
/// longer makes a clone().
struct RequestInfo : tlm::tlm_extension<RequestInfo> {
    static constexpr std::uint32_t kMostQos = 15;

    RequestStream stream = RequestStream::Other;
    /// 0 to kMostQos as AxQOS of AMBA AXI: AcceleratorOptions::Memory::qos. Lpddr5 lets reads of a
    /// higher level into its queues before others.
    std::uint32_t qos = 0;

    tlm::tlm_extension_base* clone() const override {
        auto* const copy = new RequestInfo;
        copy->copy_from(*this);
        return copy;
    }
    void copy_from(const tlm::tlm_extension_base& other) override {
        const auto& from = static_cast<const RequestInfo&>(other);
        stream = from.stream;
        qos = from.qos;
    }
};

} // namespace degs
