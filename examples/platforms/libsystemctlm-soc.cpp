// SPDX-License-Identifier: Apache-2.0
// Xilinx's libsystemctlm-soc: the accelerator's memory traffic crosses AXI4 signals of 128 bits at
// 500 MHz, and all addresses are decoded by the library's interconnect.
//     libsystemctlm-soc DESIGN.yaml SCENE [WIDTH]
#include "host.hpp"

#include <tlm_utils/simple_target_socket.h>
#include <tlm_utils/tlm_quantumkeeper.h>

using namespace sc_core; // the headers of the library take these for granted
using namespace sc_dt;
using namespace std;

#include <soc/interconnect/iconnect.h>
#include <test-modules/memory.h>
#include <test-modules/signals-axi.h>
#include <tlm-bridges/axi2tlm-bridge.h>
#include <tlm-bridges/tlm2axi-bridge.h>

int sc_main(int argc, char* argv[]) {
    try {
        const Order order(argc, argv);
        degs::AcceleratorOptions options;
        options.antialiased = order.scene.antialiased;
        options.memory.burst_bytes = 64; // a burst crosses no boundary of 4 KiB
        degs::Accelerator accelerator("accelerator", order.design, options);
        Host host("host", order, kRegisters);
        sc_signal<bool> irq("irq"), reset_n("reset_n", true);
        sc_clock clock("clock", 2, SC_NS);

        tlm2axi_bridge<64, 128> to_axi("to_axi");
        AXISignals<64, 128> axi("axi");
        axi2tlm_bridge<64, 128> from_axi("from_axi");
        iconnect<3, 2> interconnect("interconnect");
        memory ram("ram", sc_time(80, SC_NS), off_t(kMemoryBytes));

        accelerator.mem.bind(to_axi.tgt_socket);
        axi.connect(&to_axi);
        axi.connect(&from_axi);
        to_axi.clk.bind(clock);
        to_axi.resetn.bind(reset_n);
        from_axi.clk.bind(clock);
        from_axi.resetn.bind(reset_n);

        from_axi.socket.bind(*interconnect.t_sk[0]);
        host.memory.bind(*interconnect.t_sk[1]);
        host.registers.bind(*interconnect.t_sk[2]);
        interconnect.memmap(kRegisters, kRegisterBytes - 1, ADDRMODE_RELATIVE, -1,
                            accelerator.registers);
        interconnect.memmap(kMemory, kMemoryBytes - 1, ADDRMODE_RELATIVE, -1, ram.socket);
        accelerator.irq.bind(irq);
        host.irq.bind(irq);
        sc_start();
        return host.rendered ? 0 : 1;
    } catch (const degs::InputError& mistake) {
        std::printf("%s\n", mistake.what());
        return 2;
    }
}
