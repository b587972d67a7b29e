// SPDX-License-Identifier: Apache-2.0
/// RestPlaces: where renderables rested before they began to move, for motion vectors. With them a renderer keeps the
/// places of what moves, and of nothing else (prepare/LastFrame.h).
///   Thread  the app thread between frames; save() on many threads at once, each with its own renderables.
///   Memory  none until a renderer asks; then a byte a renderable, and 64 bytes for each of eight neighbours of which
///           one moves.
///   Fails   ask(): std::bad_alloc. save(): never; without memory the place is unknown.
#pragma once

#include "filament_core/scene/Placement.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace filament_core::scene {

class RestPlaces {
public:
    RestPlaces() = default;
    RestPlaces(RestPlaces const&) = delete;
    RestPlaces& operator=(RestPlaces const&) = delete;
    ~RestPlaces() {
        for (Eight* eight : mEights) delete eight;
    }

    /// From now on places are saved, of these positions.
    void ask(uint32_t count) {
        if (mEights.size() * 8 < count) mEights.resize((count + 7) / 8);
    }
    void save(uint32_t at, Placement const& placement) noexcept {
        if (at / 8 >= mEights.size()) return; // added since a renderer asked
        std::atomic_ref shared(mEights[at / 8]);
        Eight* eight = shared.load(std::memory_order_acquire);
        if (!eight) {
            Eight* const made = new (std::nothrow) Eight;
            if (!made) return;
            if (shared.compare_exchange_strong(eight, made, std::memory_order_acq_rel))
                eight = made;
            else
                delete made; // a neighbour was first
        }
        eight->places[at % 8] = placement;
        eight->isSaved[at % 8] = true;
    }
    /// Null: none was saved.
    Placement const* find(uint32_t at) const {
        Eight const* eight = at / 8 < mEights.size() ? mEights[at / 8] : nullptr;
        return eight && eight->isSaved[at % 8] ? &eight->places[at % 8] : nullptr;
    }
    /// Forgets positions 64 word to 64 word + 63, except those of eights with a bit in `kept`.
    void drop(size_t word, uint64_t kept) {
        for (size_t i = word * 8; i < std::min(word * 8 + 8, mEights.size()); ++i, kept >>= 8) {
            if (!mEights[i] || (kept & 0xFF) != 0) continue;
            delete mEights[i];
            mEights[i] = nullptr;
        }
    }
    bool isAsked() const { return !mEights.empty(); }

private:
    struct Eight {
        std::array<Placement, 8> places;
        std::array<bool, 8> isSaved{};
    };
    std::vector<Eight*> mEights;
};

} // namespace filament_core::scene
