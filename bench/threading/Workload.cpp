// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Workload.h"

#include "base/Statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace filament_core::bench {
namespace {

Verdict judge(Target const& target, Measured const& measured) {
    Verdict verdict{ .target = target };
    Series const* series = measured.find(target.contender);
    if (!series) return verdict;
    switch (target.figure) {
    case Figure::Median:
        verdict.value = quartiles(series->all).median;
        break;
    case Figure::P99:
        verdict.value = quantile(series->all, 0.99);
        break;
    case Figure::Ratio: {
        const std::optional<double> ratio = measured.ratio(target.contender, target.other);
        if (!ratio) return verdict;
        verdict.value = *ratio;
        break;
    }
    }
    verdict.isMet = target.atLeast ? verdict.value >= target.limit : verdict.value <= target.limit;
    return verdict;
}

} // namespace

Series const* Measured::find(std::string const& contender) const {
    const auto found = std::ranges::find(series, contender, &Series::name);
    return found == series.end() || found->rounds.empty() ? nullptr : &*found;
}

std::optional<double> Measured::ratio(std::string const& a, std::string const& b) const {
    Series const *left = find(a), *right = find(b);
    if (!left || !right) return std::nullopt;
    return quartiles(pairedRatios(left->rounds, right->rounds)).median;
}

std::string describe(Target const& target, std::string const& unit) {
    const char* relation = target.atLeast ? ">=" : "<=";
    switch (target.figure) {
    case Figure::Median:
        return fmt::format("{} {} {:g} {}", target.contender, relation, target.limit, unit);
    case Figure::P99:
        return fmt::format("{} p99 {} {:g} {}", target.contender, relation, target.limit, unit);
    case Figure::Ratio:
        break;
    }
    return fmt::format("{} / {} {} {:g}", target.contender, target.other, relation, target.limit);
}

Rounds::Rounds(Workload workload) : mWorkload(std::move(workload)) {
    for (Contender const& contender : mWorkload.contenders)
        mSeries.push_back({ contender.name, contender.note, {}, {} });
}

double Rounds::runOne() {
    std::vector<double> figures;
    for (size_t i = 0; i < mWorkload.contenders.size(); ++i) {
        figures.clear();
        mWorkload.contenders[i].sample(figures);
        if (figures.empty()) continue;
        mSeries[i].rounds.push_back(quartiles(figures).median);
        mSeries[i].all.insert(mSeries[i].all.end(), figures.begin(), figures.end());
    }
    const auto ours = std::ranges::find(mSeries, "ours", &Series::name);
    Series const& headline = ours == mSeries.end() ? mSeries.front() : *ours;
    return headline.rounds.empty() ? 0 : headline.rounds.back();
}

Measured Rounds::finish() && {
    Measured measured{ .name = mWorkload.name,
                       .title = mWorkload.title,
                       .unit = mWorkload.unit,
                       .kind = mWorkload.kind,
                       .x = mWorkload.x,
                       .series = std::move(mSeries),
                       .verdicts = {},
                       .leftOut = std::move(mWorkload.leftOut) };
    for (Target const& target : mWorkload.targets) measured.verdicts.push_back(judge(target, measured));
    return measured;
}

} // namespace filament_core::bench
