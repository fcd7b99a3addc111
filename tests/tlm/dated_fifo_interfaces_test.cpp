// SPDX-License-Identifier: Apache-2.0
// The standard TLM-1 interfaces of the dated FIFO: foreign blocks, which live in kernel time.
#include <random>

#include <gtest/gtest.h>

#include "tests/tlm/script.hpp"
#include "tlm/dated_fifo.hpp"
#include "tlm/has_process.hpp"

namespace degs {
namespace {

using sc_core::sc_time;
using sc_core::sc_time_stamp;
using test::Script;

/// A foreign block: one port of a standard interface and one SC_THREAD.
template <class Interface>
class Foreign : public sc_core::sc_module {
public:
    sc_core::sc_port<Interface> port;
    Foreign(const sc_core::sc_module_name& name, std::function<void(Interface&)> body)
        : sc_core::sc_module(name), port("port"), body_(std::move(body)) {
        DEGS_HAS_PROCESS(Foreign);
        SC_THREAD(run);
    }

private:
    void run() { body_(*port[0]); }
    std::function<void(Interface&)> body_;
};
using BlockingWriter = Foreign<tlm::tlm_blocking_put_if<int>>;
using BlockingReader = Foreign<tlm::tlm_blocking_get_peek_if<int>>;
using PollingWriter = Foreign<tlm::tlm_nonblocking_put_if<int>>;
using PollingReader = Foreign<tlm::tlm_nonblocking_get_peek_if<int>>;

sc_time ns(Cycle cycles) {
    return {static_cast<double>(cycles), sc_core::SC_NS};
}
Cycle now() {
    return ClockDomain(1.0).ceil(sc_time_stamp());
}

std::vector<Cycle> random_gaps(unsigned seed, std::size_t count) {
    std::mt19937 random(seed);
    std::vector<Cycle> gaps;
    for (std::size_t i = 0; i < count; ++i) {
        gaps.push_back(i / 20 % 2 == 0 ? random() % 6 : random() % 2);
    }
    return gaps;
}

constexpr std::size_t kItems = 200;
constexpr Cycle kDepth = 3;

/// write(i) = max(a_w, read(i - D) + Lb), read(i) = max(a_r, write(i) + Lf); gaps before each.
struct Expected {
    std::vector<Cycle> written, read;
    Expected(const std::vector<Cycle>& writer, const std::vector<Cycle>& reader, Cycle forward,
             Cycle release) {
        Cycle w = 0;
        Cycle r = 0;
        for (std::size_t i = 0; i < writer.size(); ++i) {
            w = std::max(w + writer[i], i < kDepth ? 0 : read[i - kDepth] + release);
            r = std::max(r + reader[i], w + forward);
            written.push_back(w);
            read.push_back(r);
        }
    }
};

/// Two foreign blocks around any FIFO that has the blocking interfaces; kernel time of each call.
template <class Fifo>
struct BlockingPair {
    std::vector<Cycle> written, read;
    std::vector<int> values, peeked;
    BlockingWriter writer;
    BlockingReader reader;
    BlockingPair(const char* name, Fifo& fifo)
        : writer((std::string(name) + "_writer").c_str(),
                 [this](tlm::tlm_blocking_put_if<int>& out) { write(out); }),
          reader((std::string(name) + "_reader").c_str(),
                 [this](tlm::tlm_blocking_get_peek_if<int>& in) { take(in); }) {
        writer.port.bind(fifo);
        reader.port.bind(fifo);
    }
    void write(tlm::tlm_blocking_put_if<int>& out) {
        for (const Cycle gap : random_gaps(1, kItems)) {
            sc_core::wait(ns(gap));
            out.put(static_cast<int>(written.size()));
            written.push_back(now());
        }
    }
    void take(tlm::tlm_blocking_get_peek_if<int>& in) {
        for (const Cycle gap : random_gaps(2, kItems)) {
            sc_core::wait(ns(gap));
            if (gap % 2 == 1) {
                peeked.push_back(in.peek() - static_cast<int>(values.size()));
            }
            values.push_back(in.get());
            read.push_back(now());
        }
    }
};

// A block that knows nothing of dates cannot tell a dated FIFO without latencies from tlm_fifo.
TEST(DatedFifoInterfaces, ForeignBlocksSeeNoDifferenceToTlmFifo) {
    const Timebase time;
    DatedFifo<int> dated("dated", time, kDepth, 0, 0);
    tlm::tlm_fifo<int> plain("plain", kDepth);
    const BlockingPair<DatedFifo<int>> a("a", dated);
    const BlockingPair<tlm::tlm_fifo<int>> b("b", plain);
    sc_core::sc_start();
    EXPECT_EQ(a.written.size(), kItems);
    EXPECT_EQ(a.written, b.written);
    EXPECT_EQ(a.read, b.read);
    EXPECT_EQ(a.values, b.values);
    EXPECT_EQ(a.peeked, std::vector<int>(a.peeked.size(), 0)); // peeking takes nothing
    const Expected expected(random_gaps(1, kItems), random_gaps(2, kItems), 0, 0);
    EXPECT_EQ(a.written, expected.written);
    EXPECT_EQ(a.read, expected.read);
}

TEST(DatedFifoInterfaces, ForeignBlocksSeeTheLatencies) {
    const Timebase time;
    DatedFifo<int> dated("dated", time, kDepth, 4, 2);
    const BlockingPair<DatedFifo<int>> pair("pair", dated);
    sc_core::sc_start();
    const Expected expected(random_gaps(1, kItems), random_gaps(2, kItems), 4, 2);
    EXPECT_EQ(pair.written, expected.written);
    EXPECT_EQ(pair.read, expected.read);
}

/// A dated writer or reader, which runs ahead of the kernel as far as it can.
struct DatedSide {
    Process self;
    std::vector<Cycle> dates;
    explicit DatedSide(const Timebase& time) : self(time) {}
    void write(DatedFifo<int>& fifo, const std::vector<Cycle>& gaps) {
        for (const Cycle gap : gaps) {
            self.advance(gap);
            fifo.put(self, static_cast<int>(dates.size()));
            dates.push_back(self.local());
        }
    }
    void take(DatedFifo<int>& fifo, const std::vector<Cycle>& gaps) {
        for (const Cycle gap : gaps) {
            self.advance(gap);
            EXPECT_EQ(fifo.get(self), static_cast<int>(dates.size()));
            dates.push_back(self.local());
        }
    }
};

struct Latencies {
    Cycle forward, release;
};
std::ostream& operator<<(std::ostream& out, const Latencies& l) {
    return out << "forward" << l.forward << "_release" << l.release;
}
class DatedFifoInterfacesWith : public ::testing::TestWithParam<Latencies> {
protected:
    const std::vector<Cycle> writer_gaps = random_gaps(3, kItems);
    const std::vector<Cycle> reader_gaps = random_gaps(4, kItems);
    const Expected expected{writer_gaps, reader_gaps, GetParam().forward, GetParam().release};
    Timebase time;
    DatedFifo<int> fifo{"fifo", time, kDepth, GetParam().forward, GetParam().release};
    DatedSide dated{time};
};

TEST_P(DatedFifoInterfacesWith, ABlockingForeignWriter) {
    std::vector<Cycle> written;
    BlockingWriter writer("writer", [&](tlm::tlm_blocking_put_if<int>& out) {
        for (const Cycle gap : writer_gaps) {
            sc_core::wait(ns(gap));
            out.put(static_cast<int>(written.size()));
            written.push_back(now());
        }
    });
    writer.port.bind(fifo);
    const Script reader("reader", [&] { dated.take(fifo, reader_gaps); });
    sc_core::sc_start();
    EXPECT_EQ(written, expected.written);
    EXPECT_EQ(dated.dates, expected.read);
}

TEST_P(DatedFifoInterfacesWith, ABlockingForeignReader) {
    std::vector<Cycle> read;
    BlockingReader reader("reader", [&](tlm::tlm_blocking_get_peek_if<int>& in) {
        for (const Cycle gap : reader_gaps) {
            sc_core::wait(ns(gap));
            EXPECT_EQ(in.peek(), static_cast<int>(read.size()));
            EXPECT_EQ(in.get(), static_cast<int>(read.size()));
            read.push_back(now());
        }
    });
    reader.port.bind(fifo);
    const Script writer("writer", [&] { dated.write(fifo, writer_gaps); });
    sc_core::sc_start();
    EXPECT_EQ(read, expected.read);
    EXPECT_EQ(dated.dates, expected.written);
}

// The reader frees cells at dates ahead of the kernel; each of them must wake the writer.
TEST_P(DatedFifoInterfacesWith, APollingForeignWriterIsWokenByOkToPut) {
    std::vector<Cycle> written;
    PollingWriter writer("writer", [&](tlm::tlm_nonblocking_put_if<int>& out) {
        for (const Cycle gap : writer_gaps) {
            sc_core::wait(ns(gap));
            while (!out.nb_put(static_cast<int>(written.size()))) {
                EXPECT_FALSE(out.nb_can_put());
                sc_core::wait(out.ok_to_put());
            }
            written.push_back(now());
        }
    });
    writer.port.bind(fifo);
    const Script reader("reader", [&] { dated.take(fifo, reader_gaps); });
    sc_core::sc_start();
    EXPECT_EQ(written, expected.written);
    EXPECT_EQ(dated.dates, expected.read);
}

// The writer leaves several items with dates ahead of the kernel; each of them must wake the
// reader.
TEST_P(DatedFifoInterfacesWith, APollingForeignReaderIsWokenByOkToGet) {
    std::vector<Cycle> read;
    PollingReader reader("reader", [&](tlm::tlm_nonblocking_get_peek_if<int>& in) {
        for (const Cycle gap : reader_gaps) {
            sc_core::wait(ns(gap));
            int peeked = -1;
            while (!in.nb_peek(peeked)) {
                EXPECT_FALSE(in.nb_can_get());
                EXPECT_FALSE(in.nb_can_peek());
                sc_core::wait(read.size() % 2 == 0 ? in.ok_to_get() : in.ok_to_peek());
            }
            int value = -1;
            EXPECT_TRUE(in.nb_get(value));
            EXPECT_EQ(value, static_cast<int>(read.size()));
            EXPECT_EQ(peeked, value);
            read.push_back(now());
        }
    });
    reader.port.bind(fifo);
    const Script writer("writer", [&] { dated.write(fifo, writer_gaps); });
    sc_core::sc_start();
    EXPECT_EQ(read, expected.read);
    EXPECT_EQ(dated.dates, expected.written);
}

INSTANTIATE_TEST_SUITE_P(Latencies, DatedFifoInterfacesWith,
                         ::testing::Values(Latencies{0, 0}, Latencies{1, 0}, Latencies{3, 2}));

// A foreign block between cycles acts in the next one.
TEST(DatedFifoInterfaces, BetweenCyclesCountsAsTheNext) {
    const Timebase time;
    DatedFifo<int> fifo("fifo", time, 2, 1, 0);
    Process reader(time);
    BlockingWriter writer("writer", [&](tlm::tlm_blocking_put_if<int>& out) {
        sc_core::wait(2.3, sc_core::SC_NS);
        out.put(7);
    });
    writer.port.bind(fifo);
    const Script read("read", [&] {
        EXPECT_EQ(fifo.get(reader), 7);
        EXPECT_EQ(reader.local(), 4U);
    });
    sc_core::sc_start();
    EXPECT_EQ(reader.local(), 4U);
}

} // namespace
} // namespace degs
