// SPDX-License-Identifier: Apache-2.0
#ifndef MachineContext_h
#define MachineContext_h

namespace subdivision_benchmark
{

/** Adds to the measurements what they depend on: the processor, ITK, the compiler, the kernel's instruction set and the
 * system's mode of transparent huge pages. */
void
AddMachineContext();

} // namespace subdivision_benchmark

#endif
