// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <systemc>
#include <tlm>

#include "tlm/event_log.hpp"
#include "tlm/process.hpp"

namespace degs {

/// A bounded FIFO whose cells carry dates, so that its two sides need not meet in kernel time
/// ("Smart FIFO", Helmstetter et al., DATE 2013). Depth D, forward latency Lf, release latency Lb:
///     write(i) = max(a_w, read(i - D) + Lb)      read(i) = max(a_r, write(i) + Lf)
/// where a_w, a_r are the dates at which the sides are ready. One writer and one reader process.
/// A FIFO of depth kWire never pushes back: write(i) = a_w.
///
/// The host allocates cells as they are needed, so that a depth costs memory only if it is used.
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
        Cycle late_cycles = 0;      ///< reader ready, no answer to put_at(), first item apart
        Cycle occupied_cycles = 0;  ///< sum of read(i) - write(i); mean fill = this / elapsed
        std::size_t high_water = 0; ///< most items inside at one date; <= depth
    };

    DatedFifo(const sc_core::sc_module_name& name, const Timebase& time, std::size_t depth,
              Cycle forward_latency = 1, Cycle release_latency = 0)
        : sc_core::sc_module(name),
          FifoBase(forward_latency, release_latency), time_{time.clock, Fidelity::Exact},
          cells_(std::clamp<std::size_t>(depth, 1, kFirstCells)), first_(cells_.data()),
          end_(first_ + cells_.size()), front_(first_), tail_(first_), earlier_(first_),
          capacity_(cells_.size()) {
        depth_ = std::max<std::size_t>(depth, 1);
        room_ = depth_;
        head_ = &front_->date;
        free_ = &tail_->date;
        if (time.timeline != nullptr) {
            in_timeline_ = true;
            time.timeline->join(*this);
        }
    }

    /// Another depth from the next item on. All items must have been read, at dates before that of
    /// the next write, and nobody may hold on to one. The high-water mark stays.
    void set_depth(std::size_t depth) {
        if (depth == depth_) {
            return;
        }
        depth_ = std::max<std::size_t>(depth, 1);
        room_ = depth_;
        renew(std::min(depth_, std::max(capacity_, stats_.high_water)));
        left_.clear();
    }

    const Stats& stats() const { return stats_; }
    /// True if a log, a foreign block or a timeline looks at what passes.
    bool attended() const { return attended_ || in_timeline_; }
    const char* fifo_name() const override { return sc_core::sc_object::name(); }
    Use use() const override {
        return {stats_.items, stats_.occupied_cycles, &stats_.full_cycles, &stats_.empty_cycles};
    }
    Cycle residence(std::uint64_t items, Cycle date) const override {
        Cycle sum = 0;
        const Cell* cell = front_; // cells before it keep the dates of what was read last
        for (std::uint64_t i = items; i < stats_.items; ++i) {
            cell = (cell == first_ ? end_ : cell) - 1;
            sum += date - cell->written;
        }
        cell = front_;
        for (std::size_t i = 0; i < filled_ + late_.size(); ++i, cell = next(cell)) {
            sum += date > cell->written ? date - cell->written : 0;
        }
        return sum;
    }

    /// Waits for a free cell and moves the writer to the date from which it is free.
    void reserve(Process& writer) {
        writer_ = &writer;
        if (full() || tail_->date > writer.local()) {
            make_room(writer);
        }
    }
    /// True if reserve(), which has to follow, will not move the writer's date. The answer is
    /// certain, as that of Process::arrived(); for FIFOs with Lb >= 1, so that what is read in
    /// cycle t makes room from t + 1 on, whoever is asked first.
    bool has_room(Process& writer) {
        return full() ? writer.gains_room(*this) : room_date() <= writer.local();
    }
    /// has_room(), and reserve() if there is.
    bool reserve_now(Process& writer) {
        if (!has_room(writer)) {
            return false;
        }
        writer_ = &writer;
        if (tail_->date > writer.local()) {
            make_room(writer); // the host has too few cells
        }
        return true;
    }
    /// Must not follow put_at() with an answer that has not come yet.
    void put(Process& writer, const T& value) {
        reserve(writer);
        tail_->value = value;
        commit(writer, 0);
    }
    /// Like put(), but the item may be read from `ready` on at the earliest (data that is on its
    /// way). Items stay in order: one whose answer is late holds back those behind it.
    void put_at(Process& writer, const T& value, const Completion& ready) {
        reserve(writer);
        from_memory_ = true;
        tail_->value = value;
        if (late_.empty() && ready.known()) {
            commit(writer, ready.date());
        } else {
            hold(writer, ready);
        }
    }
    /// The cell that put_staged() hands over. The writer fills it in place after reserve().
    T& staged() { return tail_->value; }
    /// Writes the staged item, at the date of reserve() or later.
    void put_staged(Process& writer) { commit(writer, 0); }
    /// The oldest item; moves the reader to the date from which it may be read.
    T get(Process& reader) {
        T value = arrive(reader);
        drop(reader);
        return value;
    }
    /// Like get(), but leaves the item in its cell, so that large items need no copy; drop()
    /// follows.
    const T& arrive(Process& reader) {
        wait_for_item(reader);
        if (from_memory_) {
            count_late(reader.local());
        }
        reader.advance_to(front_->date, stats_.empty_cycles);
        return front_->value;
    }
    /// The oldest item without removing it. Only if not empty().
    const T& front() const { return front_->value; }
    /// Counts how late the oldest item is, for arrive() and for a reader that has waited for it
    /// since `ready` in another way.
    void count_late(Cycle ready) {
        const Cycle from = std::max(ready, front_->written + forward_latency_);
        if (stats_.items != 0 && front_->date > from) {
            stats_.late_cycles += front_->date - from;
        }
    }
    /// Removes the oldest item, which must be readable at the reader's date.
    T take(Process& reader) {
        T value = front_->value;
        drop(reader);
        return value;
    }
    void drop(Process& reader) {
        const Cycle now = reader.local();
        const Cell* const taken = front_;
        const Cycle readable = front_->date;
        stats_.items++;
        stats_.occupied_cycles += now - front_->written;
        if (stats_.high_water < depth_) {
            count_fill();
        }
        front_->read = now;
        front_->date = now + release_latency_;
        const bool was_full = filled_-- == room_;
        front_ = next(front_);
        head_ = &front_->date;
        if (attended_) {
            show_take(taken->value, readable, now);
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

    /// Logs what is written as events `kind` of port `port` of the writer.
    void log_puts(EventLog& log, const char* kind, std::size_t port = 0) {
        puts_ = logged(log, kind, port, false);
    }
    /// Logs what is read as events `kind` of port `port` of the reader: the cycle in which it is
    /// taken, and the cycles for which it could have been.
    void log_takes(EventLog& log, const char* kind, std::size_t port = 0) {
        takes_ = logged(log, kind, port, true);
    }
    /// Logs when the reader takes what was written, as events `kind` of port `port` of the writer,
    /// which say no more than log_takes() does about dates.
    void log_departures(EventLog& log, const char* kind, std::size_t port = 0) {
        attended_ = true;
        departures_ = {&log, log.kind(kind, {{"port", {}}, {"waited", {}}}),
                       static_cast<std::int64_t>(port)};
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
        return !full() && time_.clock.at(room_date()) <= sc_core::sc_time_stamp();
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
        return filled_ != 0 && time_.clock.at(front_->date) <= sc_core::sc_time_stamp();
    }
    const sc_core::sc_event& ok_to_get(tlm::tlm_tag<T>* = nullptr) const override {
        listen();
        return foreign_item_;
    }
    T peek(tlm::tlm_tag<T>* = nullptr) const override {
        auto& self = const_cast<DatedFifo&>(*this);
        Process& process = self.foreign(self.foreign_reader_);
        self.wait_for_item(process);
        process.advance_to(front_->date);
        process.sync();
        return front_->value;
    }
    bool nb_peek(T& value) const override {
        if (!nb_can_peek()) {
            return false;
        }
        value = front_->value;
        return true;
    }
    bool nb_can_peek(tlm::tlm_tag<T>* = nullptr) const override { return nb_can_get(); }
    const sc_core::sc_event& ok_to_peek(tlm::tlm_tag<T>* = nullptr) const override {
        listen();
        return foreign_item_;
    }

private:
    static constexpr std::size_t kFirstCells = 16;
    struct Cell {
        Cycle date = 0; // filled: readable from; free: writable from
        Cycle written = 0;
        Cycle read = kNever;
        T value{};
    };
    void commit(Process& writer, Cycle ready) {
        const Cell* const written = tail_;
        tail_->written = writer.local();
        tail_->date = std::max(writer.local() + forward_latency_, ready);
        const bool was_empty = filled_++ == 0;
        tail_ = next(tail_);
        free_ = &tail_->date;
        if (filled_ == capacity_ && capacity_ < depth_) {
            grow(); // so that tail_ is free unless the ring is full
        }
        if (attended_) {
            show_put(*written);
        }
        // Last, because a reader without a thread takes the item at once.
        if (was_empty && reader_ != nullptr && reader_->blocked()) {
            reader_->wake();
        }
    }
    /// The staged item takes its cell, but cannot be read before those that are late and its own
    /// answer.
    __attribute__((noinline)) void hold(Process& writer, const Completion& ready) {
        const Cell* const written = tail_;
        tail_->written = writer.local();
        tail_ = next(tail_);
        free_ = &tail_->date;
        --room_;
        late_.push_back(ready);
        late_from_ = late_.size() == 1 ? writer.local() + forward_latency_ : late_from_;
        if (filled_ + late_.size() == capacity_ && capacity_ < depth_) {
            grow();
        }
        if (attended_) {
            show_put(*written);
        }
        ready.when_known([this](Cycle /*date*/) { settle(); });
    }
    void settle() {
        const bool was_empty = filled_ == 0;
        while (!late_.empty() && late_.front().known()) {
            Cell& cell = late_cell();
            cell.date = std::max(cell.written + forward_latency_, late_.front().date());
            late_.pop_front();
            ++room_;
            ++filled_;
        }
        late_from_ = late_.empty() ? ~Cycle{0} : late_cell().written + forward_latency_;
        if (attended_) {
            announce();
        }
        if (was_empty && filled_ != 0 && reader_ != nullptr && reader_->blocked()) {
            reader_->wake();
        }
    }
    /// The cell of the first late item, which lies behind the last one that is not.
    Cell& late_cell() {
        const std::size_t place = static_cast<std::size_t>(front_ - first_) + filled_;
        return first_[place < capacity_ ? place : place - capacity_];
    }
    /// The cell to be written holds no item, but its last one was read later than the writer's
    /// date, or there is none.
    __attribute__((noinline)) void make_room(Process& writer) {
        if (capacity_ < depth_) {
            grow();
            return;
        }
        while (full()) {
            writer.block_on_room(*this);
        }
        writer.advance_to(tail_->date, stats_.full_cycles);
    }
    /// More cells, and that many for an empty ring; see dated_fifo_cells.hpp.
    __attribute__((noinline)) void grow();
    void renew(std::size_t count);
    /// Raises the high-water mark if more items than that were inside when the item now read was
    /// written: itself, and those before it that were read later. It uses dates alone, because the
    /// number of items in the ring depends on how far the host lets its sides run ahead. An item
    /// read at the very date is gone. Items are read in order, so it is enough to ask whether the
    /// item that many places before was still inside; the mark rises by one item at a time.
    void count_fill() {
        if (earlier_->read > front_->written) {
            stats_.high_water++; // the next item asks for the same cell, one place further back
        } else {
            earlier_ = next(earlier_);
        }
    }
    template <class AnyCell>
    AnyCell* next(AnyCell* cell) const {
        AnyCell* const first = first_; // loaded in any case, so that no branch is needed
        ++cell;
        return cell == end_ ? first : cell;
    }
    Cycle room_date() const { return capacity_ < depth_ ? 0 : tail_->date; }
    void listen() const {
        foreign_listens_ = true;
        attended_ = true;
        announce();
    }
    __attribute__((noinline)) void show_put(const Cell& cell) const {
        announce();
        if (puts_.log != nullptr) {
            puts_.log->begin(puts_.kind, cell.written);
            puts_.log->put(puts_.port);
            FieldValues values(*puts_.log);
            visit_fields(cell.value, values);
        }
    }
    __attribute__((noinline)) void show_take(const T& value, Cycle readable, Cycle now) const {
        announce();
        if (departures_.log != nullptr) {
            departures_.begin_take(readable, now);
        }
        if (takes_.log != nullptr) {
            takes_.begin_take(readable, now);
            FieldValues values(*takes_.log);
            visit_fields(value, values);
        }
    }
    LoggedSide logged(EventLog& log, const char* kind, std::size_t port, bool takes) {
        std::vector<EventLog::Field> fields{{"port", {}}};
        if (takes) {
            fields.push_back({"waited", {}});
        }
        FieldNames names;
        visit_fields(T(), names);
        fields.insert(fields.end(), names.fields().begin(), names.fields().end());
        attended_ = true;
        return {&log, log.kind(kind, fields), static_cast<std::int64_t>(port)};
    }
    /// An event remembers its earliest notification only. So the next item and the next free cell
    /// are announced anew whenever a side has moved or a foreign block starts to listen.
    __attribute__((noinline)) void announce() const {
        if (!foreign_listens_) {
            return;
        }
        if (filled_ != 0) {
            notify_foreign(foreign_item_, front_->date);
        }
        if (!full()) {
            notify_foreign(foreign_room_, room_date());
        }
    }
    void notify_foreign(sc_core::sc_event& event, Cycle date) const {
        const sc_core::sc_time now = sc_core::sc_time_stamp();
        const sc_core::sc_time target = time_.clock.at(date);
        event.notify(target > now ? target - now : sc_core::SC_ZERO_TIME);
    }
    /// The process that represents a foreign block; its date is that of the kernel.
    Process& foreign(std::unique_ptr<Process>& side) {
        if (!side) {
            side = std::make_unique<Process>(time_);
        }
        side->advance_to(time_.clock.ceil(sc_core::sc_time_stamp()));
        return *side;
    }

    Timebase time_;
    std::vector<Cell> cells_;
    Cell* first_;
    Cell* end_;
    Cell* front_;
    Cell* tail_;
    Cell* earlier_;        // stats_.high_water places before front_, see count_fill()
    std::size_t capacity_; // cells; no more than depth_
    std::vector<std::vector<Cell>> left_; // cells that were too few
    std::deque<Completion> late_;         // of items behind the readable ones, see hold()
    bool from_memory_ = false;            // put_at() has been called
    Stats stats_;
    std::unique_ptr<Process> foreign_writer_;
    std::unique_ptr<Process> foreign_reader_;
    mutable bool foreign_listens_ = false; // somebody asked for ok_to_get() or ok_to_put()
    mutable bool attended_ = false;        // by foreign blocks or by a log
    bool in_timeline_ = false;
    LoggedSide puts_, takes_, departures_;
    mutable sc_core::sc_event foreign_item_;
    mutable sc_core::sc_event foreign_room_;
};

/// The port through which a block uses a FIFO.
template <class T>
class FifoPort : public sc_core::sc_port<DatedFifo<T>> {
public:
    using sc_core::sc_port<DatedFifo<T>>::sc_port;
    /// The FIFO that the port is bound to, from the end of elaboration on; SystemC reports an
    /// error if there is none. Blocks keep it, because asking the port costs a check every time.
    DatedFifo<T>& ring() { return *this->operator->(); }
};

} // namespace degs

#include "tlm/dated_fifo_cells.hpp"
