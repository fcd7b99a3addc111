// SPDX-License-Identifier: Apache-2.0
#include "base/shared_bytes.hpp"

#include <atomic>
#include <cstring>
#include <functional>

#include <sys/mman.h>

namespace degs {
namespace {

constexpr std::size_t kSlots = std::size_t{1} << 17U; // a power of two
constexpr std::size_t kMostSteps = 32;                // from the first slot of a hash
constexpr std::size_t kAlignment = 8;

} // namespace

struct SharedBytes::Slot {
    std::atomic<std::uint64_t> hash; // 0: free
    std::atomic<const char*> bytes;  // the key, then the value; nullptr: being written
    std::size_t key_size, size;
};

struct SharedBytes::Head {
    std::atomic<std::size_t> used;
};

SharedBytes::SharedBytes(std::size_t bytes) {
    static_assert(std::atomic<std::uint64_t>::is_always_lock_free &&
                      std::atomic<const char*>::is_always_lock_free,
                  "processes share them");
    const std::size_t size = sizeof(Head) + kSlots * sizeof(Slot) + bytes;
    void* const memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                                MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) {
        return;
    }
    size_ = size;
    head_ = static_cast<Head*>(memory); // zeros: nothing is used, all slots are free
    head_->used = sizeof(Head) + kSlots * sizeof(Slot);
}

SharedBytes::~SharedBytes() {
    if (head_ != nullptr) {
        ::munmap(head_, size_);
    }
}

SharedBytes::Slot* SharedBytes::place(std::uint64_t hash, std::size_t step) const {
    return reinterpret_cast<Slot*>(head_ + 1) + ((hash + step) & (kSlots - 1));
}

std::string_view SharedBytes::find(std::string_view key) const {
    if (head_ == nullptr) {
        return {};
    }
    const std::uint64_t hash = std::hash<std::string_view>()(key) | 1U;
    for (std::size_t step = 0; step < kMostSteps; ++step) {
        const Slot& slot = *place(hash, step);
        const std::uint64_t taken = slot.hash.load(std::memory_order_relaxed);
        if (taken == 0) {
            return {};
        }
        const char* const bytes = slot.bytes.load(std::memory_order_acquire);
        if (taken == hash && bytes != nullptr && key == std::string_view(bytes, slot.key_size)) {
            const std::size_t begin = (slot.key_size + kAlignment - 1) / kAlignment * kAlignment;
            return {bytes + begin, slot.size};
        }
    }
    return {};
}

char* SharedBytes::allocate(std::size_t bytes) {
    const std::size_t wanted = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    std::size_t before = head_->used.load();
    do {
        if (wanted > size_ - before) {
            return nullptr;
        }
    } while (!head_->used.compare_exchange_weak(before, before + wanted));
    return reinterpret_cast<char*>(head_) + before;
}

void SharedBytes::put(std::string_view key, std::string_view bytes) {
    if (head_ == nullptr) {
        return;
    }
    const std::size_t begin = (key.size() + kAlignment - 1) / kAlignment * kAlignment;
    const std::uint64_t hash = std::hash<std::string_view>()(key) | 1U;
    for (std::size_t step = 0; step < kMostSteps; ++step) {
        Slot& slot = *place(hash, step);
        std::uint64_t taken = 0;
        if (slot.hash.compare_exchange_strong(taken, hash)) {
            char* const copy = allocate(begin + bytes.size());
            if (copy != nullptr) {
                std::memcpy(copy, key.data(), key.size());
                std::memcpy(copy + begin, bytes.data(), bytes.size());
                slot.key_size = key.size();
                slot.size = bytes.size();
                slot.bytes.store(copy, std::memory_order_release);
            }
            return;
        }
        if (taken == hash) { // nearly always the same key
            return;
        }
    }
}

std::size_t SharedBytes::used() const {
    return head_ == nullptr ? 0 : head_->used.load() - sizeof(Head) - kSlots * sizeof(Slot);
}

} // namespace degs
