// SPDX-License-Identifier: Apache-2.0
#include "tests/filament_core/generated/AllPairs.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace filament_core::test {
namespace {

/// Which pairs are still to be met: a bit for each two values of two factors.
class OpenPairs {
public:
    explicit OpenPairs(std::span<const uint32_t> counts) : mFirst(counts.size()) {
        for (size_t factor = 0; factor < counts.size(); ++factor) {
            mFirst[factor] = mValues;
            mValues += counts[factor];
        }
        mOpen.assign(mValues * mValues, false);
        for (size_t a = 0; a < counts.size(); ++a)
            for (size_t b = a + 1; b < counts.size(); ++b) open(a, counts[a], b, counts[b]);
    }

    size_t count() const { return mCount; }
    bool isOpen(size_t a, uint32_t valueA, size_t b, uint32_t valueB) const {
        return mOpen[indexOf(a, valueA, b, valueB)];
    }
    void close(PairRow const& row) {
        for (size_t a = 0; a < row.size(); ++a) {
            for (size_t b = a + 1; b < row.size(); ++b) {
                const size_t index = indexOf(a, row[a], b, row[b]);
                mCount -= mOpen[index] ? 1 : 0;
                mOpen[index] = false;
            }
        }
    }

private:
    void open(size_t a, uint32_t countA, size_t b, uint32_t countB) {
        for (uint32_t valueA = 0; valueA < countA; ++valueA)
            for (uint32_t valueB = 0; valueB < countB; ++valueB) mOpen[indexOf(a, valueA, b, valueB)] = true;
        mCount += static_cast<size_t>(countA) * countB;
    }
    size_t indexOf(size_t a, uint32_t valueA, size_t b, uint32_t valueB) const {
        const size_t first = mFirst[a] + valueA, second = mFirst[b] + valueB;
        return std::min(first, second) * mValues + std::max(first, second);
    }

    std::vector<size_t> mFirst; ///< number of each factor's first value
    size_t mValues = 0, mCount = 0;
    std::vector<bool> mOpen;
};

using PartOfRow = std::vector<std::optional<uint32_t>>;

size_t gainOf(OpenPairs const& open, PartOfRow const& row, size_t factor, uint32_t value) {
    size_t gain = 0;
    for (size_t other = 0; other < row.size(); ++other)
        if (other != factor && row[other]) gain += open.isOpen(factor, value, other, *row[other]) ? 1 : 0;
    return gain;
}

uint32_t bestValue(OpenPairs const& open, PartOfRow const& row, size_t factor, uint32_t count, Chance& chance) {
    const uint32_t first = chance.below(count);
    uint32_t best = first;
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t value = (first + i) % count;
        if (gainOf(open, row, factor, value) > gainOf(open, row, factor, best)) best = value;
    }
    return best;
}

/// The first open pair after a place of chance.
void begin(OpenPairs const& open, std::span<const uint32_t> counts, Chance& chance, PartOfRow& row) {
    const auto factors = static_cast<uint32_t>(counts.size());
    const uint32_t first = chance.below(factors);
    for (uint32_t i = 0; i < factors; ++i) {
        const uint32_t a = (first + i) % factors;
        for (uint32_t b = 0; b < factors; ++b) {
            for (uint32_t pair = 0; b != a && pair < counts[a] * counts[b]; ++pair) {
                if (!open.isOpen(a, pair / counts[b], b, pair % counts[b])) continue;
                row[a] = pair / counts[b], row[b] = pair % counts[b];
                return;
            }
        }
    }
}

PairRow nextRow(OpenPairs const& open, std::span<const uint32_t> counts, Chance& chance) {
    PartOfRow row(counts.size());
    begin(open, counts, chance, row);
    std::vector<size_t> order(counts.size());
    std::iota(order.begin(), order.end(), size_t{ 0 });
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[chance.below(static_cast<uint32_t>(i))]);
    for (const size_t factor : order)
        if (!row[factor]) row[factor] = bestValue(open, row, factor, counts[factor], chance);
    PairRow whole;
    for (std::optional<uint32_t> const& value : row) whole.push_back(*value);
    return whole;
}

} // namespace

std::vector<PairRow> allPairs(std::span<const uint32_t> counts, uint32_t seed) {
    Chance chance(seed);
    OpenPairs open(counts);
    std::vector<PairRow> rows;
    if (counts.size() == 1) {
        for (uint32_t value = 0; value < counts[0]; ++value) rows.push_back({ value });
        return rows;
    }
    while (open.count() > 0) {
        rows.push_back(nextRow(open, counts, chance));
        open.close(rows.back());
    }
    return rows;
}

size_t missingPairs(std::span<const uint32_t> counts, std::span<const PairRow> rows) {
    OpenPairs open(counts);
    for (PairRow const& row : rows) open.close(row);
    return open.count();
}

} // namespace filament_core::test
