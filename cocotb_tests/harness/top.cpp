// SPDX-License-Identifier: Apache-2.0
// Functions that call the Verilated class of one design. verilated_sim.cpp calls these functions instead of the
// class, so it is compiled only once for all designs.
#include "Vtop.h"
#if VM_TRACE
#include "verilated_vcd_c.h"
#endif

namespace {
Vtop* the_top;
}
void top_create() { the_top = new Vtop(""); }
void top_eval_step() { the_top->eval_step(); }
void top_eval_end_step() { the_top->eval_end_step(); }
std::uint64_t top_next_time() { return the_top->eventsPending() ? the_top->nextTimeSlot() : ~0ULL; }
void top_final() { the_top->final(); }
#if VM_TRACE
void top_trace(VerilatedVcdC* file) { the_top->trace(file, 99); }
#endif
