// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/amounts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "base/ratio.hpp"

namespace degs::sim {
namespace {

/// Counters of units do not say which of them are peaks, but all peaks are called so.
bool is_peak(const StatDoc& doc) {
    const std::string name = doc.name, ending = "high_water";
    return name.size() >= ending.size() &&
           name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

class Collector {
public:
    void operator()(double& amount) { list.push_back(amount); }
    void operator()(std::uint64_t& amount) { list.push_back(real_of(amount)); }
    void operator()(Counters& counters) {
        for (const Counters::Counter& counter : counters) {
            list.push_back(real_of(counter.value));
        }
    }
    std::vector<double> list;
};

class Setter {
public:
    explicit Setter(const std::vector<double>& list) : list_(list) {}
    void operator()(double& amount) { amount = next(); }
    void operator()(std::uint64_t& amount) { amount = whole(next()); }
    void operator()(Counters& counters) {
        Counters changed;
        for (const Counters::Counter& counter : counters) {
            const std::uint64_t amount = whole(next());
            changed.statistic(counter.doc,
                              StatValue(is_peak(counter.doc) ? counter.value : amount));
        }
        counters = changed;
    }
    bool at_end() const { return at_ == list_.size(); }

private:
    static std::uint64_t whole(double amount) {
        return static_cast<std::uint64_t>(std::llround(std::max(amount, 0.0)));
    }
    double next() {
        if (at_end()) {
            throw std::logic_error("a sample has counted other things than its result");
        }
        return list_[at_++];
    }
    const std::vector<double>& list_;
    std::size_t at_ = 0;
};

double cells(const BufferUse& buffer) {
    return real_of(buffer.rings * buffer.depth);
}

/// All amounts in their order. Shares become amounts on the way in and shares again on the way out.
template <class Visit>
void each_amount(AcceleratorResult& run, Visit& visit) {
    visit(run.hazards);
    visit(run.tiles_cancelled);
    for (StageUse& stage : run.stages) {
        visit(stage.busy_cycles);
        visit(stage.counters);
    }
    for (BufferUse& buffer : run.buffers) {
        visit(buffer.mean_fill);
        visit(buffer.full_cycles);
        visit(buffer.empty_cycles);
        visit(buffer.counters);
    }
    for (StreamUse& stream : run.streams) {
        visit(stream.bytes_read);
        visit(stream.bytes_written);
        visit(stream.requests);
    }
    for (cost::Activity& activity : run.activity) {
        visit(activity.operations);
    }
    visit(run.memory_utilization);
    if (run.dram_energy) {
        for (const dram::EnergyClass& energy : dram::kEnergyClasses) {
            visit((*run.dram_energy).*energy.nj);
        }
    }
}

} // namespace

std::vector<double> amounts_of(const AcceleratorResult& result) {
    AcceleratorResult run = result;
    for (BufferUse& buffer : run.buffers) {
        buffer.mean_fill *= cells(buffer) * real_of(run.cycles);
    }
    run.memory_utilization *= real_of(run.memory_window);
    Collector collector;
    each_amount(run, collector);
    return collector.list;
}

AcceleratorResult with_amounts(AcceleratorResult shape, const std::vector<double>& amounts) {
    Setter setter(amounts);
    each_amount(shape, setter);
    if (!setter.at_end()) {
        throw std::logic_error("a sample has counted other things than its result");
    }
    const auto per = [](double amount, double whole) { return whole > 0 ? amount / whole : 0.0; };
    const double cycles = real_of(shape.cycles);
    for (StageUse& stage : shape.stages) {
        stage.busy = std::min(1.0, per(stage.busy_cycles, stage.units * cycles));
    }
    for (BufferUse& buffer : shape.buffers) {
        buffer.mean_fill = std::min(1.0, per(buffer.mean_fill, cells(buffer) * cycles));
    }
    shape.memory_utilization =
        std::min(1.0, per(shape.memory_utilization, real_of(shape.memory_window)));
    return shape;
}

} // namespace degs::sim
