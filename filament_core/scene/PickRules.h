// SPDX-License-Identifier: Apache-2.0
/// PickRules: nodes that picks pass through (KHR_node_selectability, KHR_node_hoverability), by slot of Transforms.
///   Memory  none until a node has a rule; then 16 B a node.
///   Thread  the app thread.   Fails: std::bad_alloc.
#pragma once

#include <filament_core/Objects.h>

#include <cstdint>
#include <vector>

namespace filament_core::scene {

class PickRules {
public:
    void set(uint32_t slot, PickAim aim, bool isHit) {
        if (isHit && slot >= mRules.size()) return;
        uint8_t& passed = at(slot).passed;
        passed = static_cast<uint8_t>(isHit ? passed & ~bit(aim) : passed | bit(aim));
    }
    /// The node is hit only where `other` is; of that, and not of its parent, it inherits.
    void follow(uint32_t slot, Node other) { at(slot).followed = other; }
    void drop(uint32_t slot) {
        if (slot < mRules.size()) mRules[slot] = {};
    }

    bool empty() const { return mRules.empty(); }
    bool passes(uint32_t slot, PickAim aim) const {
        return slot < mRules.size() && (mRules[slot].passed & bit(aim)) != 0;
    }
    /// None: it inherits of its parent.
    Node followed(uint32_t slot) const { return slot < mRules.size() ? mRules[slot].followed : Node{}; }

private:
    struct Rule {
        uint8_t passed = 0; ///< a set of PickAims
        Node followed{};
    };
    static uint8_t bit(PickAim aim) { return static_cast<uint8_t>(1 << static_cast<uint8_t>(aim)); }
    Rule& at(uint32_t slot) {
        if (slot >= mRules.size()) mRules.resize(size_t{ slot } + 1);
        return mRules[slot];
    }

    std::vector<Rule> mRules;
};

} // namespace filament_core::scene
