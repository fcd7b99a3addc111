// SPDX-License-Identifier: Apache-2.0
// The rings that carry the messages between blocks, compiled once: message_rings.cpp. Calls of a
// block are still expanded in place.
#pragma once

#include "modules/kit/job/messages.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {

extern template class DatedFifo<TileNumber>;
extern template class DatedFifo<ProjectedChunk>;
extern template class DatedFifo<SortedRun>;
extern template class DatedFifo<TileRequest>;
extern template class DatedFifo<SplatChunk>;
extern template class DatedFifo<ChunkSliced>;
extern template class DatedFifo<RowCount>;
extern template class DatedFifo<RowSolved>;
extern template class DatedFifo<ChunkReleased>;
extern template class DatedFifo<RowItem>;
extern template class DatedFifo<SpanItem>;
extern template class DatedFifo<TaskPacket>;
extern template class DatedFifo<Termination>;
extern template class DatedFifo<RegionEnded>;
extern template class DatedFifo<SliceReport>;

} // namespace degs
