// SPDX-License-Identifier: Apache-2.0
#include "tlm/lpddr5_channels.hpp"

#include <algorithm>

namespace degs {

void Lpddr5Config::describe(ConfigVisitor& visitor) {
    visitor.integer("channels", channels, 1, 64,
                    "x16 channels, a power of two; 16 are 256 bit, the paper's main memory");
    visitor.require((channels & (channels - 1)) == 0, "channels", "must be a power of two");
    visitor.real("controller_latency_ns", controller_latency_ns, 0.0, 1000.0,
                 "ns; added to every answer, rounded up to CK; 0: the DRAM and its queues alone");
    visitor.integer("waiting_requests", waiting_requests, 1, 65536,
                    "per initiator; so many may wait for room in the queues before the next one is "
                    "held back (AT) [assumed]");
    visitor.boolean("dmi", dmi, "grant direct memory access, which takes no time in the model");
    visitor.section("timing", timing, "one x16 channel: organisation, and durations in CK");
    visitor.section("mapping", mapping, "address to channel, bank group, bank, row and column");
    visitor.section("controller", controller, "queues and policies of a channel");
    visitor.section("energy", energy, "what an event costs in the DRAM");
}

namespace {

/// Answers to requests from id `first` on go into their dates; how many these are. The highest bit
/// of an id is that of `first` or the answer is somebody else's.
std::uint32_t note_answers(const std::vector<Lpddr5Answer>& answers, std::uint32_t first,
                           std::vector<Ck>& dates) {
    constexpr std::uint32_t kKind = 0x80000000U;
    std::uint32_t noted = 0;
    for (const Lpddr5Answer& answer : answers) {
        const std::uint32_t index = (answer.id - first) & ~kKind;
        if ((answer.id & kKind) == (first & kKind) && index < dates.size()) {
            dates[index] = std::max(dates[index], answer.date);
            ++noted;
        }
    }
    return noted;
}

} // namespace

Lpddr5Channels::Lpddr5Channels(const Lpddr5Config& config)
    : timing_(config.timing), rules_(config.timing),
      mapping_(config.mapping, config.timing, static_cast<unsigned>(config.channels)),
      posted_writes_(config.controller.posted_writes) {
    const auto count = static_cast<std::size_t>(config.channels);
    channels_.reserve(count);
    for (std::size_t c = 0; c < count; ++c) {
        const Ck phase =
            config.controller.refresh_stagger ? static_cast<Ck>(config.timing.refi) * c / count : 0;
        channels_.emplace_back(timing_, rules_, config.controller, phase);
    }
    due_.assign(count, kNoDate);
    live_.assign(count, 0);
    asked_.assign(count, 0);
}

void Lpddr5Channels::split(const Lpddr5Request& request, std::uint32_t id) {
    constexpr std::uint64_t kBlock = kLpddr5AccessBytes;
    const std::uint64_t end = request.address + request.bytes;
    const unsigned burst = timing_.burst_bytes();
    for (std::uint64_t block = request.address / kBlock * kBlock; block < end; block += kBlock) {
        const std::uint64_t from = std::max(request.address, block) - block;
        const std::uint64_t to = std::min(end - block, kBlock) - 1;
        const Lpddr5Place place = mapping_.place(block);
        Lpddr5Access access;
        access.date = request.date;
        access.id = id;
        access.row = place.row;
        access.bank = static_cast<std::uint8_t>(place.bank);
        access.block = static_cast<std::uint8_t>(place.block);
        access.bursts = static_cast<std::uint8_t>((2U << to / burst) - (1U << from / burst));
        access.write = request.write;
        push_access(place.channel, access);
    }
}

void Lpddr5Channels::push_access(unsigned channel, const Lpddr5Access& access) {
    channels_[channel].push(access);
    writes_somewhere_ = writes_somewhere_ || access.write;
    if ((access.id & kPredicted) != 0) {
        ++asked_[channel];
        return;
    }
    ++live_[channel];
    ++progress_[access.id].unanswered;
    ++progress_[access.id].waiting;
    const bool at_once = exactly_ || channels_[channel].has_writes();
    const Ck due = at_once ? access.date : access.date + timing_.read_latency() - 1;
    due_[channel] = std::min(due_[channel], due);
}

void Lpddr5Channels::push(const Lpddr5Request& request) {
    if (request.id >= progress_.size()) {
        progress_.resize(request.id + 1);
    }
    progress_[request.id] = {};
    split(request, request.id);
}

Ck Lpddr5Channels::due() const {
    return *std::min_element(due_.begin(), due_.end());
}

// Where a write may wait, a read may be answered from it at once, so nothing can stay behind.
Ck Lpddr5Channels::due_of(bool write, Ck date) const {
    const bool at_once = exactly_ || write || writes_somewhere_;
    return at_once ? date : date + timing_.read_latency() - 1;
}

void Lpddr5Channels::watch_admissions(bool exactly) {
    if (exactly && !exactly_) {
        for (std::size_t c = 0; c < size(); ++c) {
            due_[c] = live_[c] == 0 ? kNoDate : std::min(due_[c], channel_due(channels_[c]));
        }
    }
    exactly_ = exactly;
}

void Lpddr5Channels::run(Ck until) {
    for (std::size_t c = 0; c < size(); ++c) {
        if (due_[c] <= until) {
            run_channel(c, until);
        }
    }
    writes_somewhere_ = std::any_of(channels_.begin(), channels_.end(),
                                    [](const Lpddr5Channel& c) { return c.has_writes(); });
}

void Lpddr5Channels::run_channel(std::size_t channel, Ck until) {
    Lpddr5Channel& runner = channels_[channel];
    outcome_.answers.clear();
    outcome_.admitted.clear();
    runner.run(until, outcome_);
    for (const std::uint32_t id : outcome_.admitted) {
        if ((id & kPredicted) == 0 && --progress_[id].waiting == 0) {
            admitted_.push_back(id);
        }
    }
    for (const Lpddr5Answer& answer : outcome_.answers) {
        if ((answer.id & kPredicted) != 0) {
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

// Who waits for a queue is noticed by its initiator, and may be a read that a queued write answers
// at once; who is in it, when the data come.
Ck Lpddr5Channels::channel_due(Lpddr5Channel& channel) const {
    const Ck data = posted_writes_ ? timing_.read_latency()
                                   : std::min(timing_.read_latency(), timing_.write_latency());
    const Ck due = channel.next_date() + data - 1;
    return exactly_ || channel.has_writes() ? std::min(due, channel.admission_bound()) : due;
}

std::uint32_t Lpddr5Channels::push_for_prediction(const Lpddr5Request& request) {
    const std::uint32_t ticket = tickets_;
    tickets_ = (tickets_ + 1) & ~kPredicted;
    split(request, ticket | kPredicted);
    return ticket;
}

std::vector<Ck> Lpddr5Channels::predict(std::uint32_t first, Ck known) {
    std::vector<Ck> dates((tickets_ - first) & ~kPredicted, 0);
    for (std::size_t c = 0; c < size(); ++c) {
        if (asked_[c] != 0) {
            run_channel(c, known);
            // A posted write that comes at `known` has been answered by now.
            asked_[c] -= note_answers(outcome_.answers, first | kPredicted, dates);
            predict_channel(c, first, dates);
            asked_[c] = 0;
        }
    }
    return dates;
}

void Lpddr5Channels::predict_channel(std::size_t channel, std::uint32_t first,
                                     std::vector<Ck>& dates) {
    // A new copy: assigning over the old one crashed in optimised builds, with long requests
    // waiting.
    copy_ = std::make_unique<Lpddr5Channel>(channels_[channel]);
    copy_->observe({});
    std::uint32_t missing = asked_[channel];
    while (missing != 0) {
        outcome_.answers.clear();
        outcome_.admitted.clear();
        copy_->run(copy_->next_date(), outcome_);
        missing -= note_answers(outcome_.answers, first | kPredicted, dates);
    }
}

void Lpddr5Channels::settle(Ck until) {
    for (std::size_t c = 0; c < size(); ++c) {
        run_channel(c, until);
    }
}

} // namespace degs
