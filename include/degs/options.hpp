// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "degs/keys.hpp"

namespace degs {

class Timeline;

/// How processes are kept in order. Both give the same dates and decisions. `Strict`: every process
/// sleeps to each of its dates and looks at inputs half a cycle later. `Exact`: processes run ahead
/// on their own dates and ask for proof only where order matters.
enum class Fidelity { Strict, Exact };

/// `Lt`: b_transport(), whose annotated delay lets a stream have several accesses in flight.
/// `At`: four phases, for memories without b_transport(); as many accesses are in flight.
enum class Transport { Lt, At };

/// Where a run of bytes begins or ends inside of a burst. `Pieces`: it is cut into smaller
/// naturally aligned transactions. `FullBursts`: the whole burst, with byte enables if it is
/// written.
enum class BurstEnds { Pieces, FullBursts };

/// What becomes of an access that the platform refuses. `End`: it counts as done, and the frame
/// ends with an error. `Stall`: it waits, and an interrupt tells software, which lets it go out
/// again when it has, for instance, mapped the page, or gives the frame up.
enum class RefusedAccess { End, Stall };

/// When an accelerator issues the accesses of its streams. Its blocks run ahead of the kernel on
/// dates of their own, which a memory that serves transactions in the order of the calls must not
/// see.
///
/// `Exact`: at their dates, half a cycle late, when no stream can make another one of the same
/// date; in the order of the streams where dates are equal. The half cycle is taken off the answer
/// again. What a memory sees then depends on dates alone, not on the order in which the host runs
/// processes. `Quantum`: annotated up to the next multiple of the tlm::tlm_global_quantum, as a
/// quantum keeper does; an access beyond it waits for its date. `Exact` if there is no quantum.
/// `Annotated`: at once, however far ahead. For targets that sort by date, such as the memories of
/// this project: a context switch less per access.
enum class Pacing { Exact, Quantum, Annotated };

/// What an accelerator on a platform does beside its design. docs/accelerator.md has a table.
struct AcceleratorOptions {
    /// The largest limit on the Gaussians of a scene, whose geometry then takes 44 GiB. Indices
    /// have 32 bits.
    static constexpr std::uint32_t kMostGaussians = 1U << 30U;
    /// The largest Power::wake_ns, a second.
    static constexpr double kMostWakeNs = 1e9;

    struct Limits {
        std::uint32_t gaussians = kMostGaussians; ///< of a scene, at least 1
        std::uint64_t pixels = 1U << 26U;         ///< of a frame, at least 1
    };
    /// How accesses leave the socket `mem`.
    struct Memory {
        Transport transport = Transport::Lt;
        /// AT: transactions of all streams in flight at a time; at least 1.
        unsigned outstanding = 64;
        /// AT: likewise, of one stream.
        unsigned outstanding_per_stream = ~0U;
        /// LT: likewise, of all streams; 0, the default, is no bound. Only with `burst_bytes`.
        unsigned lt_outstanding = 0;
        /// B; accesses are cut into naturally aligned transactions of a power of two up to this. A
        /// power of two from 4 on, or 0, which cuts at `boundary_bytes` alone.
        std::uint64_t burst_bytes = 0;
        BurstEnds burst_ends = BurstEnds::Pieces; ///< FullBursts: only with `burst_bytes`
        /// B; no transaction crosses a multiple of this, a power of two from 4 on, such as the 4096
        /// of AMBA AXI. 0: `burst_bytes` alone decides. FullBursts: at least `burst_bytes`.
        std::uint64_t boundary_bytes = 0;
        unsigned qos = 0; ///< 0 to RequestInfo::kMostQos
        RefusedAccess faults = RefusedAccess::End;
        Pacing pacing = Pacing::Exact; ///< AT is exact
    };

    /// The supply while no frame is rendered, if software has it gated (register POWER). [assumed]:
    /// power switches are said to cut leakage to a tenth or a fiftieth, and what a supply takes to
    /// come back is the platform's.
    struct Power {
        double gated_leakage = 0.05; ///< share of the leakage that is left, 0 to 1
        double wake_ns = 0;          ///< from a start to the frame, 0 to 1e9
    };

    Limits limits;
    Fidelity fidelity = Fidelity::Exact;
    bool antialiased = false; ///< what the files of its scenes say, see MemoryScene
    Memory memory;
    Power power;
    Timeline* timeline =
        nullptr; ///< for programs built from the sources; must outlive the accelerator

    /// All but the timeline, as keys: "memory.transport".
    void visit(KeyVisitor& visitor);
    /// Assigns one of them by its name, as Design::set() does.
    void set(const std::string& key, const std::string& value);
};

} // namespace degs
