// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <systemc>
#include <tlm>

#include "tlm/process.hpp"

namespace degs {

/// A bounded FIFO whose cells carry dates, so that its two sides need not meet in kernel time
/// ("Smart FIFO", Helmstetter et al., DATE 2013). Depth D, forward latency Lf, release latency Lb:
///     write(i) = max(a_w, read(i - D) + Lb)      read(i) = max(a_r, write(i) + Lf)
/// where a_w, a_r are the dates at which the sides are ready. One writer and one reader process.
///
/// Blocks use the calls that take their Process. The standard TLM-1 interfaces are implemented for
/// foreign blocks, which live in kernel time. A FIFO whose reader asks Process::next_arrival()
/// needs Lf >= 1, so that what is written in cycle t cannot be wanted in cycle t.
template <class T>
class DatedFifo final : public sc_core::sc_module,
                        public FifoBase,
                        public tlm::tlm_put_if<T>,
                        public tlm::tlm_get_peek_if<T> {
public:
    struct Stats {
        std::uint64_t items = 0;
        Cycle full_cycles = 0;      ///< writer ready, no free cell: sum of write(i) - a_w
        Cycle empty_cycles = 0;     ///< reader ready, no item: sum of read(i) - a_r
        Cycle occupied_cycles = 0;  ///< sum of read(i) - write(i); mean fill = this / elapsed
        std::size_t high_water = 0; ///< most items inside at one date; <= depth
    };

    DatedFifo(const sc_core::sc_module_name& name, const Timebase& time, std::size_t depth,
              Cycle forward_latency = 1, Cycle release_latency = 0)
        : sc_core::sc_module(name),
          FifoBase(forward_latency, release_latency), time_{time.clock, Fidelity::Exact},
          values_(std::max<std::size_t>(depth, 1)), dates_(values_.size(), 0),
          written_(values_.size(), 0), read_(values_.size(), 0) {
        depth_ = values_.size();
        free_ = dates_.data();
    }

    std::size_t depth() const { return values_.size(); }
    const Stats& stats() const { return stats_; }
    const char* fifo_name() const override { return sc_core::sc_object::name(); }

    /// Waits for a free cell and moves the writer to the date from which it is free.
    void reserve(Process& writer) {
        writer_ = &writer;
        const Cycle ready = writer.local();
        while (filled_ == values_.size()) {
            writer.block_on_room(*this);
        }
        writer.advance_to(dates_[tail_]);
        stats_.full_cycles += writer.local() - ready;
    }
    void put(Process& writer, const T& value) { put_at(writer, value, 0); }
    /// Like put(), but the item may be read from `ready` on at the earliest (data that is on its
    /// way).
    void put_at(Process& writer, const T& value, Cycle ready) {
        reserve(writer);
        values_[tail_] = value;
        commit(writer, ready);
    }
    /// The cell that put_staged() will hand over, to be filled in place after reserve().
    T& staged() { return values_[tail_]; }
    void put_staged(Process& writer) {
        reserve(writer);
        commit(writer, 0);
    }
    /// The oldest item; moves the reader to the date from which it may be read.
    T get(Process& reader) {
        const T value = arrive(reader);
        drop(reader);
        return value;
    }
    /// Like get(), but leaves the item in its cell, so that large items need no copy; drop()
    /// follows.
    const T& arrive(Process& reader) {
        wait_for_item(reader);
        const Cycle ready = reader.local();
        reader.advance_to(dates_[front_]);
        stats_.empty_cycles += reader.local() - ready;
        return values_[front_];
    }
    /// The oldest item without removing it. Only if not empty().
    const T& front() const { return values_[front_]; }
    /// Removes the oldest item, which must be readable at the reader's date.
    T take(Process& reader) {
        const T value = values_[front_];
        drop(reader);
        return value;
    }
    void drop(Process& reader) {
        stats_.items++;
        stats_.occupied_cycles += reader.local() - written_[front_];
        count_fill(reader.local());
        dates_[front_] = reader.local() + release_latency_;
        const bool was_full = filled_-- == values_.size();
        front_ = next(front_);
        head_ = &dates_[front_];
        if (foreign_listens_) {
            announce();
        }
        if (was_full && writer_ != nullptr && writer_->blocked()) {
            writer_->wake();
        }
    }
    void wait_for_item(Process& reader) {
        reader_ = &reader;
        while (filled_ == 0) {
            reader.block_on_item(*this);
        }
    }

    // Standard interfaces (TLM-1), for blocks that live in kernel time.
    void put(const T& value) override {
        Process& self = foreign(foreign_writer_);
        put(self, value);
        self.sync();
    }
    bool nb_put(const T& value) override {
        if (!nb_can_put()) {
            return false;
        }
        put(foreign(foreign_writer_), value);
        return true;
    }
    bool nb_can_put(tlm::tlm_tag<T>* = nullptr) const override {
        return filled_ < values_.size() &&
               time_.clock.at(dates_[tail_]) <= sc_core::sc_time_stamp();
    }
    const sc_core::sc_event& ok_to_put(tlm::tlm_tag<T>* = nullptr) const override {
        listen();
        return foreign_room_;
    }
    T get(tlm::tlm_tag<T>* = nullptr) override {
        Process& self = foreign(foreign_reader_);
        T value = get(self);
        self.sync();
        return value;
    }
    bool nb_get(T& value) override {
        if (!nb_can_get()) {
            return false;
        }
        value = take(foreign(foreign_reader_));
        return true;
    }
    bool nb_can_get(tlm::tlm_tag<T>* = nullptr) const override {
        return filled_ != 0 && time_.clock.at(dates_[front_]) <= sc_core::sc_time_stamp();
    }
    const sc_core::sc_event& ok_to_get(tlm::tlm_tag<T>* = nullptr) const override {
        listen();
        return foreign_item_;
    }
    T peek(tlm::tlm_tag<T>* = nullptr) const override {
        auto& self = const_cast<DatedFifo&>(*this);
        Process& process = self.foreign(self.foreign_reader_);
        self.wait_for_item(process);
        process.advance_to(dates_[front_]);
        process.sync();
        return values_[front_];
    }
    bool nb_peek(T& value) const override {
        if (!nb_can_peek()) {
            return false;
        }
        value = values_[front_];
        return true;
    }
    bool nb_can_peek(tlm::tlm_tag<T>* = nullptr) const override { return nb_can_get(); }
    const sc_core::sc_event& ok_to_peek(tlm::tlm_tag<T>* = nullptr) const override {
        listen();
        return foreign_item_;
    }

private:
    void commit(Process& writer, Cycle ready) {
        written_[tail_] = writer.local();
        dates_[tail_] = std::max(writer.local() + forward_latency_, ready);
        const bool was_empty = filled_++ == 0;
        if (was_empty) {
            head_ = &dates_[tail_];
        }
        tail_ = next(tail_);
        free_ = &dates_[tail_];
        if (foreign_listens_) {
            announce();
        }
        // Last, because a reader without a thread takes the item at once.
        if (reader_ != nullptr && was_empty && reader_->blocked()) {
            reader_->wake();
        }
    }
    /// Items inside at the date at which the item now read was written: itself and those before it
    /// that were read later. Told by dates alone, because how full the ring is depends on how far
    /// the host lets its sides run ahead. An item read at the very date is gone.
    void count_fill(Cycle read) {
        inside_++;
        while (inside_ > 1 && read_[oldest_] <= written_[front_]) {
            oldest_ = next(oldest_);
            inside_--;
        }
        stats_.high_water = std::max(stats_.high_water, inside_);
        read_[front_] = read;
    }
    std::size_t next(std::size_t i) const { return i + 1 == values_.size() ? 0 : i + 1; }
    void listen() const {
        foreign_listens_ = true;
        announce();
    }
    /// An event remembers its earliest notification only. So the next item and the next free cell
    /// are announced anew whenever a side has moved or a foreign block starts to listen.
    void announce() const {
        if (filled_ != 0) {
            notify_foreign(foreign_item_, dates_[front_]);
        }
        if (filled_ < values_.size()) {
            notify_foreign(foreign_room_, dates_[tail_]);
        }
    }
    void notify_foreign(sc_core::sc_event& event, Cycle date) const {
        const sc_core::sc_time now = sc_core::sc_time_stamp();
        const sc_core::sc_time target = time_.clock.at(date);
        event.notify(target > now ? target - now : sc_core::SC_ZERO_TIME);
    }
    /// The process that stands for a foreign block: its date is the kernel's.
    Process& foreign(std::unique_ptr<Process>& side) {
        if (!side) {
            side = std::make_unique<Process>(time_);
        }
        side->advance_to(time_.clock.ceil(sc_core::sc_time_stamp()));
        return *side;
    }

    Timebase time_;
    std::vector<T> values_;
    std::vector<Cycle> dates_; // filled cell: readable from; free cell: writable from
    std::vector<Cycle> written_;
    std::vector<Cycle> read_;
    std::size_t oldest_ = 0; // cell of the oldest item that count_fill() finds inside
    std::size_t inside_ = 0;
    std::size_t front_ = 0;
    std::size_t tail_ = 0;
    Stats stats_;
    std::unique_ptr<Process> foreign_writer_;
    std::unique_ptr<Process> foreign_reader_;
    mutable bool foreign_listens_ = false; // somebody asked for ok_to_get() or ok_to_put()
    mutable sc_core::sc_event foreign_item_;
    mutable sc_core::sc_event foreign_room_;
};

/// How a block names a FIFO it uses.
template <class T>
using FifoPort = sc_core::sc_port<DatedFifo<T>>;

} // namespace degs
