// SPDX-License-Identifier: Apache-2.0
#include "dram/channels.hpp"

#include <algorithm>
#include <utility>

namespace degs::dram {

void Config::describe(ConfigVisitor& visitor) {
    visitor.text("name", name, "of the memory in reports");
    visitor.integer("channels", channels, 1, 64,
                    "a power of two; 16 of 16 bits are the paper's main memory");
    visitor.require_power_of_two("channels", channels);
    visitor.real("controller_latency_ns", controller_latency_ns, 0.0, 1000.0,
                 "ns; added to every answer, rounded up to CK; 0: the DRAM and its queues alone");
    visitor.integer("waiting_requests", waiting_requests, 1, 65536,
                    "per initiator; so many may wait for room in the queues (AT) [assumed]");
    visitor.boolean("dmi", dmi, "grant direct memory access, which takes no time in the model");
    visitor.section("timing", timing, "one channel: organisation, and durations in CK");
    visitor.section("mapping", mapping, "address to channel, bank group, bank, row and column");
    visitor.section("controller", controller, "queues and policies of a channel");
    visitor.section("energy", energy, "what an event costs in the DRAM");
    const std::string problem = Mapping::problem(mapping, timing, channels);
    visitor.require(problem.empty(),
                    {"mapping.order",
                     problem,
                     Mapping::Config().order,
                     {"timing.bank_mode", "timing.banks", "timing.page_bytes", "timing.rows"}});
}

Channels::Channels(const Config& config)
    : timing_(config.timing), rules_(config.timing),
      mapping_(config.mapping, config.timing, config.channels),
      posted_writes_(config.controller.posted_writes) {
    const std::size_t count = config.channels;
    channels_.reserve(count);
    for (std::size_t c = 0; c < count; ++c) {
        const Ck phase = config.controller.refresh_stagger ? c * config.timing.refi / count : 0;
        channels_.emplace_back(timing_, rules_, config.controller, phase);
    }
    due_.assign(count, kNoDate);
    live_.assign(count, 0);
    asked_.assign(count, 0);
    futures_.resize(count);
}

void Channels::split(const Request& request, std::uint32_t id) {
    Access access;
    access.date = request.date;
    access.id = id;
    access.write = request.write;
    access.qos = request.qos;
    access.urgent = request.urgent;
    if (request.records == nullptr) {
        split_run(access, request.address, request.bytes);
    } else {
        request.records->for_each_run(
            [&](std::uint64_t address, std::uint64_t bytes) { split_run(access, address, bytes); });
    }
}

void Channels::split_run(Access access, std::uint64_t address, std::uint64_t bytes) {
    constexpr std::uint64_t kBlock = kAccessBytes;
    const std::uint64_t end = address + bytes;
    const unsigned burst = timing_.burst_bytes();
    for (std::uint64_t block = address / kBlock * kBlock; block < end; block += kBlock) {
        const std::uint64_t from = std::max(address, block) - block;
        const std::uint64_t to = std::min(end - block, kBlock) - 1;
        const Place place = mapping_.place(block);
        access.row = place.row;
        access.bank = static_cast<std::uint8_t>(place.bank);
        access.block = static_cast<std::uint8_t>(place.block);
        access.bursts = static_cast<std::uint8_t>((2U << to / burst) - (1U << from / burst));
        push_access(place.channel, access);
    }
}

void Channels::push_access(unsigned channel, const Access& access) {
    const Access marked = channels_[channel].marked(access);
    futures_[channel].push(marked);
    const bool early = channels_[channel].push(access);
    writes_somewhere_ = writes_somewhere_ || access.write;
    if ((access.id & kPredicted) != 0) {
        ++asked_[channel];
        return;
    }
    ++live_[channel];
    ++progress_[access.id].unanswered;
    ++progress_[access.id].waiting;
    const Ck due = exactly_ || early ? access.date : access.date + data_latency() - 1;
    due_[channel] = std::min(due_[channel], due);
}

void Channels::push(const Request& request) {
    if (request.id >= progress_.size()) {
        progress_.resize(request.id + 1);
    }
    progress_[request.id] = {};
    split(request, request.id);
}

Ck Channels::due() const {
    return *std::min_element(due_.begin(), due_.end());
}

// Where a write may wait, a read may be answered from it at once, so the channel must not be
// behind.
Ck Channels::due_of(bool write, Ck date) const {
    const bool at_once = exactly_ || write || writes_somewhere_;
    return at_once ? date : date + data_latency() - 1;
}

void Channels::watch_admissions(bool exactly) {
    if (exactly && !exactly_) {
        for (std::size_t c = 0; c < size(); ++c) {
            due_[c] = live_[c] == 0 ? kNoDate : std::min(due_[c], channel_due(channels_[c]));
        }
    }
    exactly_ = exactly;
}

void Channels::run(Ck until) {
    for (std::size_t c = 0; c < size(); ++c) {
        if (due_[c] <= until) {
            run_channel(c, until);
        }
    }
    writes_somewhere_ = std::any_of(channels_.begin(), channels_.end(),
                                    [](const Channel& c) { return c.has_writes(); });
}

void Channels::run_channel(std::size_t channel, Ck until) {
    Channel& runner = channels_[channel];
    outcome_.answers.clear();
    outcome_.admitted.clear();
    runner.run(until, outcome_);
    for (const std::uint32_t id : outcome_.admitted) {
        if ((id & kPredicted) == 0 && --progress_[id].waiting == 0) {
            admitted_.push_back(id);
        }
    }
    for (const Answer& answer : outcome_.answers) {
        if ((answer.id & kPredicted) != 0) {
            if (!futures_[channel].holds()) {
                take_prediction(channel, answer);
            }
            continue;
        }
        --live_[channel];
        Progress& progress = progress_[answer.id];
        progress.last = std::max(progress.last, answer.date);
        if (--progress.unanswered == 0) {
            completed_.push_back({answer.id, progress.last});
        }
    }
    due_[channel] = live_[channel] == 0 ? kNoDate : channel_due(runner);
}

// From a command to the earliest end of its data.
Ck Channels::data_latency() const {
    return posted_writes_ ? timing_.read_latency()
                          : std::min(timing_.read_latency(), timing_.write_latency());
}

// An access that waits for a queue may be answered, or noticed by its initiator, when it gets in;
// an access in the queue is answered when its data come.
Ck Channels::channel_due(Channel& channel) const {
    const Ck due = channel.next_date() + data_latency() - 1;
    return exactly_ || channel.answers_at_admission() ? std::min(due, channel.admission_bound())
                                                      : due;
}

void Channels::push_for_prediction(const Request& request) {
    const auto ticket = first_ticket_ + static_cast<std::uint32_t>(predictions_.size());
    predictions_.push_back(0);
    split(request, ticket | kPredicted);
}

std::vector<Ck> Channels::predict(Ck known) {
    for (std::size_t c = 0; c < size(); ++c) {
        if (asked_[c] != 0) {
            run_channel(c, known); // may answer some already
            predict_channel(c, known);
        }
    }
    first_ticket_ = (first_ticket_ + predictions_.size()) & ~kPredicted;
    return std::exchange(predictions_, {});
}

// A write that finds room is answered by the channel itself, and needs no future.
void Channels::predict_channel(std::size_t channel, Ck known) {
    Future& future = futures_[channel];
    if (asked_[channel] != 0) {
        future.follow(channels_[channel], known);
    }
    outcome_.admitted.clear();
    while (asked_[channel] != 0) {
        outcome_.answers.clear();
        future.step(outcome_);
        for (const Answer& answer : outcome_.answers) {
            take_prediction(channel, answer);
        }
    }
}

/// Takes an answer of a copy, unless it belongs to an earlier prediction, which is complete.
void Channels::take_prediction(std::size_t channel, const Answer& answer) {
    const std::uint32_t index = (answer.id - first_ticket_) & ~kPredicted;
    if ((answer.id & kPredicted) != 0 && index < predictions_.size()) {
        predictions_[index] = std::max(predictions_[index], answer.date);
        --asked_[channel];
    }
}

void Channels::settle(Ck until) {
    for (std::size_t c = 0; c < size(); ++c) {
        run_channel(c, until);
    }
}

} // namespace degs::dram
