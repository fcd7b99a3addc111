// SPDX-License-Identifier: Apache-2.0
// VCML: its bus decodes all addresses, and its memory, with 80 cycles of 1 GHz per access, holds
// scene and frame.
//     vcml DESIGN.yaml SCENE [WIDTH]
#include "host.hpp"

#include <vcml.h>

int sc_main(int argc, char* argv[]) {
    try {
        const Order order(argc, argv);
        degs::AcceleratorOptions options;
        options.antialiased = order.scene.antialiased;
        degs::Accelerator accelerator("accelerator", order.design, options);
        Host host("host", order, kRegisters);
        sc_core::sc_signal<bool> irq("irq");

        vcml::generic::bus bus("bus");
        vcml::generic::memory memory("memory", kMemoryBytes, false, vcml::VCML_ALIGN_NONE, 80, 80);
        for (vcml::component* part :
             {static_cast<vcml::component*>(&bus), static_cast<vcml::component*>(&memory)}) {
            part->clk.stub(vcml::GHz);
            part->rst.stub();
        }
        bus.bind(host.memory);
        bus.bind(host.registers);
        bus.bind(accelerator.mem);
        bus.bind(memory, kMemory);
        bus.bind(accelerator.registers, vcml::range(kRegisters, kRegisters + kRegisterBytes - 1));
        accelerator.irq.bind(irq);
        host.irq.bind(irq);
        sc_core::sc_start();
        return host.rendered ? 0 : 1;
    } catch (const degs::InputError& mistake) {
        std::printf("%s\n", mistake.what());
        return 2;
    }
}
