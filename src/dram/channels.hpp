// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "config/config.hpp"
#include "dram/channel.hpp"
#include "dram/energy.hpp"
#include "dram/future.hpp"
#include "dram/mapping.hpp"
#include "tlm/scattered_records.hpp"

namespace degs::dram {

/// An LPDDR5 main memory: `channels` x16 channels of one device and speed, and its controllers.
struct Config {
    std::string name = "lpddr5-6400x256";
    int channels = 16;
    double controller_latency_ns = 0.0;
    int waiting_requests = 16;
    bool dmi = false;
    Timing timing;
    Mapping::Config mapping;
    ControllerConfig controller;
    Energy::Config energy;
    void describe(ConfigVisitor& visitor);

    double peak_gb_per_s() const { return channels * timing.peak_gb_per_s(); } ///< 1e9 B/s
};

/// A request of any size, as it enters the channels.
struct Request {
    Ck date = 0;
    std::uint64_t address = 0, bytes = 0;
    std::uint32_t id = 0; ///< small; free again when the request is complete
    bool write = false;
    std::uint8_t qos = 0; ///< level of a read, 0 to 15; the higher ones wait for room first
    bool urgent = false;  ///< a read that, of its level, waits for room before those that are not
    const ScatteredRecords* records = nullptr; ///< if not null, in place of `address` and `bytes`
};

/// All channels: cuts requests into accesses and puts their answers together. Plain arithmetic.
///
/// A channel runs only when its state can matter: a read shows no earlier than RL + BL/n after its
/// command, so a channel may stay that far behind unless an answer can come from its queues.
class Channels {
public:
    explicit Channels(const Config& config);
    // The channels point to the timing and the rules in here.
    Channels(const Channels&) = delete;
    Channels& operator=(const Channels&) = delete;
    ~Channels() = default;

    /// Dates never fall, and are later than any `until` so far.
    void push(const Request& request);
    /// Runs everything up to `until` that can affect a request of push().
    void run(Ck until);
    /// Date up to which run() must be called, at the latest half a CK after it; kNoDate if no
    /// request of push() is in flight.
    Ck due() const;
    /// Date up to which run() must be called for a request that is about to be pushed.
    Ck due_of(bool write, Ck date) const;
    /// From now on admissions are reported at their dates as well, or no longer.
    void watch_admissions(bool exactly);

    /// Complete requests with the date of the last answer, and requests that do not wait for room
    /// any more; the caller empties both.
    std::vector<Answer>& completed() { return completed_; }
    std::vector<std::uint32_t>& admitted() { return admitted_; }

    /// Like push(), for a requester that wants the answer at once. The request does not appear in
    /// completed().
    void push_for_prediction(const Request& request);
    /// The dates at which the requests pushed in this way since the last call are complete if
    /// nothing more comes, found by running copies of the channels. All dates up to `known` have
    /// been pushed.
    std::vector<Ck> predict(Ck known);

    /// Updates the statistics up to `until`.
    void settle(Ck until);
    const Channel& operator[](std::size_t channel) const { return channels_[channel]; }
    Channel& operator[](std::size_t channel) { return channels_[channel]; }
    std::size_t size() const { return channels_.size(); }
    const Mapping& mapping() const { return mapping_; }

private:
    static constexpr std::uint32_t kPredicted = 0x80000000U;
    struct Progress {
        std::uint32_t unanswered = 0, waiting = 0; // accesses
        Ck last = 0;
    };
    void split(const Request& request, std::uint32_t id);
    void split_run(Access access, std::uint64_t address, std::uint64_t bytes);
    void push_access(unsigned channel, const Access& access);
    void run_channel(std::size_t channel, Ck until);
    Ck channel_due(Channel& channel) const;
    Ck data_latency() const;
    void predict_channel(std::size_t channel, Ck known);
    void take_prediction(std::size_t channel, const Answer& answer);

    Timing timing_;
    RuleTable rules_;
    Mapping mapping_;
    bool posted_writes_;
    std::vector<Channel> channels_;
    std::vector<Ck> due_;              // by channel
    std::vector<std::uint32_t> live_;  // by channel: accesses of push() without answer
    std::vector<std::uint32_t> asked_; // by channel: accesses without prediction
    std::vector<Progress> progress_;   // by id
    std::vector<Answer> completed_;
    std::vector<std::uint32_t> admitted_;
    bool exactly_ = false;
    bool writes_somewhere_ = false;
    std::uint32_t first_ticket_ = 0; // ids of the requests in predictions_
    std::vector<Ck> predictions_;
    std::vector<Future> futures_; // by channel: for predictions
    Outcome outcome_;
};

} // namespace degs::dram
