// SPDX-License-Identifier: Apache-2.0
#include "dram/controller.hpp"

#include "config/config_words.hpp"

namespace degs::dram {
namespace {

/// Visits the choice of a policy, and the keys of the policies.
void describe_policies(std::vector<PolicyHolder>& policies, int& chosen, ConfigVisitor& visitor) {
    std::vector<const char*> names;
    std::string doc;
    for (const PolicyHolder& policy : policies) {
        names.push_back(policy->name());
        doc += (doc.empty() ? "" : "; ") + std::string(policy->name()) + ": " + policy->doc();
    }
    visitor.choice("scheduler", chosen, names, doc.c_str());
    for (std::size_t p = 0; p < policies.size(); ++p) {
        Policy& policy = *policies[p];
        const bool used = p == static_cast<std::size_t>(chosen);
        if (policy.has_keys() && (used || visitor.visits_unused())) {
            visitor.section(policy.name(), policy, policy.doc());
            if (!used) {
                visitor.unused(policy.name(), "scheduler", "scheduler is another policy");
            }
        }
    }
}

} // namespace

const std::vector<PagePolicy>& page_policies() {
    static const std::vector<PagePolicy> policies{{"open", false}, {"closed", true}};
    return policies;
}

void ControllerConfig::describe(ConfigVisitor& visitor) {
    visitor.integer("read_queue", read_queue, 1, Queue::kSlots, "accesses of 64 B per channel");
    visitor.integer("write_queue", write_queue, 1, Queue::kSlots, "accesses of 64 B per channel");
    visitor.real("write_high", write_high, 0.0, 1.0,
                 "share of the write queue; from here on writes go first");
    visitor.real("write_low", write_low, 0.0, 1.0,
                 "share of the write queue; down to here if a read waits");
    visitor.require(write_low <= write_high, {"write_low",
                                              "must not be above write_high",
                                              config_words::number(write_high),
                                              {"write_high"}});
    describe_policies(policies, scheduler, visitor);
    std::vector<const char*> pages;
    for (const PagePolicy& page : page_policies()) {
        pages.push_back(page.name);
    }
    visitor.choice(
        "page_policy", page_policy, pages,
        "open: rows stay open until another is wanted; closed: the last queued access to "
        "a row precharges it");
    visitor.choice("refresh", refresh, {"none", "all_bank", "per_bank"},
                   "all_bank every refi; per_bank: a pair of banks every refi / 8; none for tests");
    visitor.boolean("refresh_stagger", refresh_stagger,
                    "spread the channels' refreshes over refi, in place of all at once");
    visitor.boolean("posted_writes", posted_writes,
                    "answer a write when its queue has it, and merge writes to one place; off: "
                    "answer with the last beat");
    visitor.integer("qos_step", qos_step, 0, Queue::kMostStep,
                    "accesses of 64 B; a read whose level (AxQOS) is one higher counts as having "
                    "come to the channel so many reads earlier, so that no level starves; as many "
                    "as the largest queue has [assumed]");
}

} // namespace degs::dram
