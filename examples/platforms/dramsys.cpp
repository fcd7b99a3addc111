// SPDX-License-Identifier: Apache-2.0
// DRAMSys as the memory of the accelerator, by four-phase AT; the host loads and reads it by debug
// transport. A checker of the base protocol, which DRAMSys has, sits between them.
//     dramsys DESIGN.yaml SCENE [WIDTH]
#include "host.hpp"

#include <DRAMSys/common/tlm2_base_protocol_checker.h>
#include <DRAMSys/config/DRAMSysConfiguration.h>
#include <DRAMSys/simulation/DRAMSys.h>

int sc_main(int argc, char* argv[]) {
    try {
        const Order order(argc, argv);
        DRAMSys::Config::Configuration config =
            DRAMSys::Config::from_path(DRAMSYS_RESOURCE_DIR "/ddr4-example.json");
        config.simconfig.StoreMode = DRAMSys::Config::StoreModeType::Store;
        config.simconfig.DatabaseRecording = false;
        DRAMSys::DRAMSys dram("dram", config);

        degs::AcceleratorOptions options;
        options.antialiased = order.scene.antialiased;
        options.memory.transport = degs::Transport::At;
        options.memory.burst_bytes = dram.getMemSpec().maxBytesPerBurst;
        degs::Accelerator accelerator("accelerator", order.design, options);
        tlm_utils::tlm2_base_protocol_checker<> checker("checker");
        Host host("host", order, 0);
        sc_core::sc_signal<bool> irq("irq");

        accelerator.mem.bind(checker.target_socket);
        checker.initiator_socket.bind(dram.tSocket);
        host.memory.bind(dram.tSocket);
        host.registers.bind(accelerator.registers);
        accelerator.irq.bind(irq);
        host.irq.bind(irq);
        sc_core::sc_start();
        return host.rendered ? 0 : 1;
    } catch (const degs::InputError& mistake) {
        std::printf("%s\n", mistake.what());
        return 2;
    }
}
