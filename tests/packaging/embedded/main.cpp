// SPDX-License-Identifier: Apache-2.0
// One write and one read on the memory of DeGS. Exits with 0 if the byte comes back.
#include <cstdio>

#include <systemc>
#include <tlm_utils/simple_initiator_socket.h>

#include <dram/lpddr5.hpp>

namespace {

struct Driver : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Driver> out{"out"};
    unsigned char back = 0;
    SC_CTOR(Driver) { SC_THREAD(run); }
    void access(tlm::tlm_command command, unsigned char& byte) {
        tlm::tlm_generic_payload p;
        p.set_command(command);
        p.set_address(12345);
        p.set_data_ptr(&byte);
        p.set_data_length(1);
        p.set_streaming_width(1);
        sc_core::sc_time delay;
        out->b_transport(p, delay);
        wait(delay);
    }
    void run() {
        unsigned char byte = 42;
        access(tlm::TLM_WRITE_COMMAND, byte);
        access(tlm::TLM_READ_COMMAND, back);
    }
};

} // namespace

int sc_main(int, char**) {
    degs::dram::Lpddr5 memory("memory", {}, degs::Timebase(), 1);
    Driver driver("driver");
    driver.out.bind(memory.in[0]);
    sc_core::sc_start();
    std::printf("read %d after %s: %s\n", driver.back, sc_core::sc_time_stamp().to_string().c_str(),
                driver.back == 42 ? "right" : "WRONG");
    return driver.back == 42 ? 0 : 1;
}
