// SPDX-License-Identifier: Apache-2.0
#include "degs/accelerator.hpp"

#include "platform/accelerator_core.hpp"
#include "tlm/has_process.hpp"

namespace degs {

Accelerator::Accelerator(const sc_core::sc_module_name& name, const Design& design,
                         const Options& options)
    : Accelerator(name, design.accelerator(), options) {}

Accelerator::Accelerator(const sc_core::sc_module_name& name, const AcceleratorConfig& config,
                         const Options& options)
    : sc_core::sc_module(name), registers("registers"), mem("mem"), irq("irq"), reset_n("reset_n"),
      clk("clk"), core_(std::make_unique<AcceleratorCore>(*this, config, options)) {
    registers.register_b_transport(this, &Accelerator::transport);
    registers.register_transport_dbg(this, &Accelerator::debug);
    DEGS_HAS_PROCESS(Accelerator);
    SC_THREAD(run);
    SC_METHOD(drive_irq);
    sensitive << core_->irq_changed();
    SC_METHOD(begin_stop);
    sensitive << core_->stop_requested() << reset_n;
    SC_METHOD(resume_access);
    sensitive << core_->resume_requested();
    dont_initialize();
}

Accelerator::~Accelerator() = default;

double Accelerator::clock_ghz() const {
    return core_->config().clock_ghz;
}

void Accelerator::set_operating_point(const OperatingPoint& point) {
    core_->set_operating_point(point);
}

const OperatingPoint& Accelerator::operating_point() const {
    return core_->operating_point();
}

void Accelerator::trace(sc_core::sc_trace_file* file) const {
    core_->trace(file);
}

void Accelerator::end_of_elaboration() {
    core_->end_of_elaboration();
}

void Accelerator::start_of_simulation() {
    core_->start_of_simulation();
}

void Accelerator::transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    core_->transport(payload, delay);
}

unsigned int Accelerator::debug(tlm::tlm_generic_payload& payload) {
    return core_->debug(payload);
}

void Accelerator::run() {
    core_->run();
}

void Accelerator::drive_irq() {
    core_->drive_irq();
}

void Accelerator::begin_stop() {
    core_->begin_stop();
}

void Accelerator::resume_access() {
    core_->resume_access();
}

} // namespace degs
