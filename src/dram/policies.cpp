// SPDX-License-Identifier: Apache-2.0
#include "dram/policies.hpp"

#include "dram/bank_fcfs.hpp"
#include "dram/fcfs.hpp"
#include "dram/frfcfs.hpp"
#include "dram/frfcfs_cap.hpp"

namespace degs::dram {

std::vector<PolicyHolder> all_policies() {
    return {
        PolicyHolder(Frfcfs{}),
        PolicyHolder(BankFcfs{}),
        PolicyHolder(Fcfs{}),
        PolicyHolder(FrfcfsCap{}),
    };
}

} // namespace degs::dram
