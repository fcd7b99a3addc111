// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>

#include "dram/controller.hpp"
#include "dram/queue.hpp"
#include "dram/waiting_reads.hpp"

namespace degs::dram {

/// The read queue and the write queue of a channel, the accesses that wait for their date or for
/// room in them, and the choice of the queue that is served. Reads go first. Writes go in batches
/// between two watermarks, or when no read waits. Reads enter the read queue and stand in it by
/// level; urgent ones of a level enter before others, which leave a share of it free for them.
class Queues {
public:
    explicit Queues(const ControllerConfig& config);

    /// The access with `writes` and `after_write` as they are when the access arrives.
    Access marked(Access access) const {
        access.writes = access.write ? writes_so_far_ + 1 : writes_up_to(access.date);
        access.after_write = !access.write && writes_of_hash_[hash(access)] != 0;
        return access;
    }
    /// Takes an access of marked(). Dates never fall per direction. True if the answer may come as
    /// soon as the queues have it.
    bool push(const Access& access);
    /// What waits separately; accesses of one kind get in in the order of their arrival.
    enum Kind : std::uint8_t { kWrite, kFavouredRead, kRead, kKinds };
    static Kind kind_of(const Access& access) {
        return access.write ? kWrite : WaitingReads::is_lowest(access) ? kRead : kFavouredRead;
    }
    /// An access of this kind that came now could get into its queue at once.
    bool welcomes(Kind kind) const {
        switch (kind) {
        case kWrite:
            return writes_in_.empty() && !writes_.full();
        case kFavouredRead:
            return !reads_.full();
        default:
            return !reads_in_.has_lowest() && room().ordinary;
        }
    }
    /// The earliest date of an access that waits and for which there is room.
    Ck next_admission() const {
        const Ck date = reads_in_.next_date(room());
        return !writes_in_.empty() && !writes_.full() ? std::min(date, writes_in_.front().date)
                                                      : date;
    }
    bool write_ready(Ck date) const {
        return !writes_in_.empty() && !writes_.full() && writes_in_.front().date <= date;
    }
    bool read_ready(Ck date) const { return reads_in_.ready(date, room()); }
    /// Takes the first that is ready; it then is enqueued, merged, or answered from a write.
    Access take_write() {
        const Access access = writes_in_.front();
        writes_in_.pop_front();
        return access;
    }
    Access take_read(Ck date) {
        const Access access = reads_in_.take(date, room());
        after_writes_ -= access.after_write ? 1 : 0;
        return access;
    }

    void enqueue_write(const Access& access) {
        note_bursts(writes_.push(access), access, access.bursts);
    }
    void enqueue_read(const Access& access) { reads_.push(access); }
    /// The slot of a queued write to the block of this write, which has been taken; kNone if there
    /// is none.
    std::uint8_t write_to_merge(const Access& access) const;
    /// Joins a write to that of write_to_merge(). Returns how many of its bursts that one was to
    /// transfer anyway.
    unsigned merge(std::uint8_t slot, const Access& access);
    /// True if waiting writes hold all bytes of this read, and came before it.
    bool covered(const Access& access) const;
    /// Takes a served access out of the current queue.
    void remove(unsigned slot);
    /// Which direction to serve from now on; true if that is another one. To be asked when the size
    /// of a queue has changed.
    bool turn() {
        const unsigned reads = reads_.size();
        const unsigned writes = writes_.size();
        const bool write = writing_ ? writes != 0 && (writes > write_low_ || reads == 0)
                                    : writes >= write_high_ || (reads == 0 && writes != 0);
        const bool turned = write != writing_;
        writing_ = write;
        return turned;
    }

    bool writing() const { return writing_; }
    /// The queue of the present direction.
    Queue& current() { return writing_ ? writes_ : reads_; }
    const Queue& current() const { return writing_ ? writes_ : reads_; }

    /// True if nothing is queued and nothing waits for a queue.
    bool idle() const;
    /// Accesses that wait for room in a queue, or for their date.
    std::size_t waiting() const { return reads_in_.size() + writes_in_.size(); }
    /// Bursts of all accesses that have not been issued, whether they wait in a queue or for one.
    std::uint64_t bursts_left() const;
    /// Something waits for room in a full queue.
    bool held_up() const {
        return reads_in_.held_up(room()) || (writes_.full() && !writes_in_.empty());
    }
    bool has_writes() const { return writes_.size() != 0 || !writes_in_.empty(); }
    /// Accesses that wait for room may be answered when they get in.
    bool answers_at_admission() const { return after_writes_ != 0 || !writes_in_.empty(); }

private:
    WaitingReads::Room room() const { return {!reads_.full(), reads_.size() < most_ordinary_}; }
    /// Writes that had come by a date. Those that are ahead of it still wait for their own.
    std::uint32_t writes_up_to(Ck date) const {
        std::uint32_t writes = writes_so_far_;
        for (auto w = writes_in_.rbegin(); w != writes_in_.rend() && w->date > date; ++w) {
            --writes;
        }
        return writes;
    }
    /// Which write brought these bursts into the slot.
    void note_bursts(std::uint8_t slot, const Access& access, unsigned bursts) {
        for (; bursts != 0; bursts &= bursts - 1) {
            brought_by_[slot][__builtin_ctz(bursts)] = access.writes;
        }
    }
    static std::size_t hash(const Access& access) {
        return (access.row * 37U + access.bank * 11U + access.block) % 256;
    }

    bool posted_writes_;
    unsigned write_high_, write_low_; // entries
    unsigned most_ordinary_;          // in the read queue no more enter that are not urgent
    Queue reads_, writes_;
    WaitingReads reads_in_;
    std::deque<Access> writes_in_; // wait for their date or for room, as reads_in_ do
    bool writing_ = false;
    // The number of waiting writes by hash. It shows at arrival that a read has nothing to wait
    // for.
    std::array<std::uint16_t, 256> writes_of_hash_{};
    std::size_t after_writes_ = 0; // waiting reads with after_write
    std::uint32_t writes_so_far_ = 0;
    // Access::writes of the first write that brought a burst, for each burst of a queued write.
    std::array<std::array<std::uint32_t, 8>, Queue::kSlots> brought_by_{};
};

} // namespace degs::dram
