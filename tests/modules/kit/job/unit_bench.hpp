// SPDX-License-Identifier: Apache-2.0
// One block with a job, a memory and scripts around it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "modules/kit/job/render_job.hpp"
#include "tests/modules/degs/workload_fixture.hpp"
#include "tests/tlm/script.hpp"
#include "tlm/dated_fifo.hpp"
#include "tlm/memory_port.hpp"

namespace degs::test {

/// What the units have in common: a job, a memory, and scripts around them.
struct UnitBench {
    Timebase time;
    FrameWorkload frame;
    RenderJob job;
    std::unique_ptr<Memory> memory;
    std::vector<std::unique_ptr<Script>> scripts;
    std::vector<std::unique_ptr<Process>> processes;

    explicit UnitBench(FrameWorkload work, int contexts = 1)
        : frame(std::move(work)),
          job(make_render_job(
              {&frame}, {Arithmetic::Fp64, SpanEnds::Exact, 0, StopRule::Refuse, {}}, contexts)) {}
    void connect(const std::vector<MemoryPort*>& ports, double latency_ns = 0,
                 double gb_per_s = 1e9) {
        Memory::Config c;
        c.latency_ns = latency_ns;
        c.bandwidth_gb_per_s = gb_per_s;
        memory = std::make_unique<Memory>("memory", c, time, ports.size());
        for (std::size_t i = 0; i < ports.size(); ++i) {
            ports[i]->out.bind(memory->in[i]);
        }
    }
    /// A process with a local date of its own.
    void script(const std::function<void(Process&)>& body) {
        processes.push_back(std::make_unique<Process>(time));
        Process& self = *processes.back();
        scripts.push_back(std::make_unique<Script>(
            ("script" + std::to_string(scripts.size())).c_str(), [body, &self] {
                body(self);
                self.finish();
            }));
    }
    /// Empties a ring; the dates at which its items could be read.
    template <class T>
    std::vector<std::pair<Cycle, T>>& drain(DatedFifo<T>& ring) {
        auto all = std::make_shared<std::vector<std::pair<Cycle, T>>>();
        keep.push_back(all);
        script([all, &ring](Process& self) {
            for (;;) {
                const T item = ring.get(self);
                all->emplace_back(self.local(), item);
            }
        });
        return *all;
    }
    std::vector<std::shared_ptr<void>> keep;
};

} // namespace degs::test
