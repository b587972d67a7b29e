// SPDX-License-Identifier: Apache-2.0
/// PipelineTable: pipelines by a 64-bit key, for a lookup a draw.
///   Layout  open addressing with linear probing, at most half full, a power of two of 16-byte entries.
///   Thread  find(): any number at a time, while nobody changes the table.
///   Memory  grows with the number of entries; a lookup allocates nothing.
///   Limits  a key is not zero.   Fails: insert() and reserveOne(), std::bad_alloc; nothing has changed then.
///   Cost    bench/filament_core/passes: 5 to 9 ns to choose the pipeline of a draw, reading the draw included.
#pragma once

#include "backend/api/Handles.h"
#include "base/Assert.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filament_core::passes {

class PipelineTable {
public:
    struct Entry {
        uint64_t key = 0; ///< zero: this place is free
        backend::PipelineHandle handle;
        uint32_t material = 0;
    };

    /// Null: never inserted. Valid until the table changes.
    Entry const* find(uint64_t key) const {
        if (mEntries.empty()) return nullptr;
        for (size_t at = home(key);; at = (at + 1) & mask()) {
            if (mEntries[at].key == key) return &mEntries[at];
            if (mEntries[at].key == 0) return nullptr;
        }
    }

    /// A key that is not in the table yet.
    void insert(Entry const& entry) {
        FILAMENT_ASSERT(entry.key != 0 && !find(entry.key), "a pipeline is inserted once, under a key that is not 0");
        reserveOne();
        place(entry);
    }

    /// The next insert() does not fail.
    void reserveOne() {
        if ((mCount + 1) * 2 > mEntries.size()) grow();
    }

    /// Removes the entries for which `isUnwanted(entry)`, in no particular order; it is asked again about some that
    /// stay. Allocates nothing.
    template <class Predicate>
    void eraseIf(Predicate&& isUnwanted) {
        for (size_t at = 0; at < mEntries.size();) {
            if (mEntries[at].key != 0 && isUnwanted(mEntries[at]))
                erase(at); // puts another entry there, or none
            else
                ++at;
        }
    }

    size_t size() const { return mCount; }

    /// How many places the worst lookup of a key in the table looks at: the quality of the hash.
    size_t longestProbe() const {
        size_t longest = 0;
        for (size_t at = 0; at < mEntries.size(); ++at) {
            if (mEntries[at].key != 0) longest = std::max(longest, ((at - home(mEntries[at].key)) & mask()) + 1);
        }
        return longest;
    }

private:
    size_t mask() const { return mEntries.size() - 1; }
    // Fibonacci hashing (2^64 / golden ratio): the top bits of the product depend on every bit of the key.
    size_t home(uint64_t key) const { return static_cast<size_t>(key * 0x9E3779B97F4A7C15ull >> mShift); }

    void place(Entry const& entry) {
        size_t at = home(entry.key);
        while (mEntries[at].key != 0) at = (at + 1) & mask();
        mEntries[at] = entry;
        ++mCount;
    }

    // Knuth, "The Art of Computer Programming" vol. 3, 6.4, algorithm R: entries that a lookup would no longer reach
    // move up into the gap.
    void erase(size_t gap) {
        --mCount;
        for (size_t at = (gap + 1) & mask(); mEntries[at].key != 0; at = (at + 1) & mask()) {
            const size_t fromHome = (at - home(mEntries[at].key)) & mask();
            if (fromHome < ((at - gap) & mask())) continue; // its home lies behind the gap
            mEntries[gap] = mEntries[at];
            gap = at;
        }
        mEntries[gap] = {};
    }

    void grow() {
        std::vector<Entry> before(mEntries.empty() ? kFirstSize : mEntries.size() * 2);
        before.swap(mEntries);
        mShift = 64 - std::countr_zero(mEntries.size());
        mCount = 0;
        for (Entry const& entry : before) {
            if (entry.key != 0) place(entry);
        }
    }

    static constexpr size_t kFirstSize = 64;
    std::vector<Entry> mEntries; // empty, or a power of two
    int mShift = 64;             // leaves log2(mEntries.size()) bits
    size_t mCount = 0;
};

} // namespace filament_core::passes
