// SPDX-License-Identifier: Apache-2.0
/// Attachments: which objects of one type are attached to which node. One doubly linked list per node, threaded through
/// the things.
///   Thread  the app thread; forEach() on any number of threads while nothing changes.
///   Memory  16 bytes per thing, 4 bytes per node; both grow to the highest index in use. Attaching and detaching are
///           O(1).
///   Fails   attaching twice is an assertion.
#pragma once

#include "base/Assert.h"

#include <filament_core/Handle.h>

#include <cstdint>
#include <vector>

namespace filament_core::scene {

template <class Tag>
class Attachments {
public:
    static constexpr uint32_t kNone = ~0u;

    /// `node` is a slot of Transforms.
    void attach(ObjectHandle<Tag> thing, uint32_t node) {
        FILAMENT_ASSERT(!isAttached(thing), "a renderable or light hangs at one node only");
        if (thing.index() >= mLinks.size()) mLinks.resize(thing.index() + 1);
        if (node >= mFirst.size()) mFirst.resize(node + 1, kNone);
        const uint32_t next = mFirst[node];
        mLinks[thing.index()] = { thing, node, next, kNone };
        if (next != kNone) mLinks[next].previous = thing.index();
        mFirst[node] = thing.index();
    }

    /// No effect on an object that is not attached.
    void detach(ObjectHandle<Tag> thing) {
        if (!isAttached(thing)) return;
        const Link link = mLinks[thing.index()];
        (link.previous == kNone ? mFirst[link.node] : mLinks[link.previous].next) = link.next;
        if (link.next != kNone) mLinks[link.next].previous = link.previous;
        mLinks[thing.index()].node = kNone;
    }

    /// kNone: it is not attached.
    uint32_t nodeOf(ObjectHandle<Tag> thing) const {
        return thing.index() < mLinks.size() ? mLinks[thing.index()].node : kNone;
    }

    bool isAttached(ObjectHandle<Tag> thing) const { return nodeOf(thing) != kNone; }

    /// none: nothing is attached to the node.
    ObjectHandle<Tag> first(uint32_t node) const {
        return node < mFirst.size() && mFirst[node] != kNone ? mLinks[mFirst[node]].thing : ObjectHandle<Tag>{};
    }

    template <class F>
    void forEach(uint32_t node, F&& visit) const {
        if (node >= mFirst.size()) return;
        for (uint32_t i = mFirst[node]; i != kNone; i = mLinks[i].next) visit(mLinks[i].thing);
    }

private:
    struct Link {
        ObjectHandle<Tag> thing{};
        uint32_t node = kNone, next = kNone, previous = kNone;
    };

    std::vector<Link> mLinks;     // by the thing's handle index
    std::vector<uint32_t> mFirst; // by node
};

} // namespace filament_core::scene
