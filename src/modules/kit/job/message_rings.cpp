// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/job/message_rings.hpp"

namespace degs {

template class DatedFifo<TileNumber>;
template class DatedFifo<ProjectedChunk>;
template class DatedFifo<SortedRun>;
template class DatedFifo<TileRequest>;
template class DatedFifo<SplatChunk>;
template class DatedFifo<ChunkSliced>;
template class DatedFifo<RowCount>;
template class DatedFifo<RowSolved>;
template class DatedFifo<ChunkReleased>;
template class DatedFifo<RowItem>;
template class DatedFifo<SpanItem>;
template class DatedFifo<TaskPacket>;
template class DatedFifo<Termination>;
template class DatedFifo<RegionEnded>;
template class DatedFifo<SliceReport>;

} // namespace degs
