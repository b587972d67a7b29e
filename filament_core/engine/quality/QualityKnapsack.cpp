// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/quality/QualityKnapsack.h"

#include "base/Assert.h"

#include <filament_core/Options.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

namespace filament_core::engine {
namespace {

constexpr double kNanosecondsPerMillisecond = 1e6, kErrorUnits = 1e12;
constexpr double kMostNanoseconds = 9e15; // a hundred days: sums over all groups still fit

/// `child` only counts if `parent` has `value`.
struct Dependence {
    std::string_view parent, value, child;
};
constexpr Dependence kDependences[] = { { "splitSum", "table", "dfgTableSize" },
                                        { "diffuseIrradiance", "sphericalHarmonics", "shBands" } };

int64_t nanosecondsOf(double milliseconds) {
    return std::llround(std::clamp(milliseconds * kNanosecondsPerMillisecond, -kMostNanoseconds, kMostNanoseconds));
}

QualityEffect const* findEffect(QualityCosts const& costs, std::string_view name) {
    const auto found = std::ranges::find(costs.effects, name, &QualityEffect::name);
    return found == costs.effects.end() ? nullptr : &*found;
}

Dependence const* dependenceOfChild(std::string_view child) {
    const auto found = std::ranges::find(kDependences, child, &Dependence::child);
    return found == std::end(kDependences) ? nullptr : &*found;
}

class GroupBuilder {
public:
    GroupBuilder(QualityCosts const& costs, Backend backend, double frameMilliseconds, Quality const& start)
            : mCosts(costs), mBackend(backend), mFrame(frameMilliseconds), mStart(start) {}

    std::vector<BudgetGroup> groups() const {
        std::vector<BudgetGroup> all;
        for (QualityEffect const& effect : mCosts.effects) {
            Dependence const* dependence = dependenceOfChild(effect.name);
            if (dependence && findEffect(mCosts, dependence->parent)) continue; // belongs to its parent's group
            if (dependence && optionValue(mStart, dependence->parent) != dependence->value) continue; // no effect
            all.push_back(groupOf(effect));
        }
        return all;
    }

private:
    BudgetGroup groupOf(QualityEffect const& effect) const {
        BudgetGroup group;
        for (QualityCost const& cost : effect.values) {
            const BudgetOption option = optionOf(effect, cost);
            QualityEffect const* child = childOf(effect, cost);
            if (!child) {
                group.options.push_back(option);
                continue;
            }
            for (QualityCost const& childCost : child->values)
                group.options.push_back(together(option, optionOf(*child, childCost)));
        }
        return group;
    }

    QualityEffect const* childOf(QualityEffect const& effect, QualityCost const& cost) const {
        for (Dependence const& dependence : kDependences) {
            if (dependence.parent == effect.name && dependence.value == cost.value)
                return findEffect(mCosts, dependence.child);
        }
        return nullptr;
    }

    BudgetOption optionOf(QualityEffect const& effect, QualityCost const& cost) const {
        const std::string standard = optionValue(Quality{}, effect.name).value_or("");
        const auto base = std::ranges::find(effect.values, standard, &QualityCost::value);
        FILAMENT_ASSERT(base != effect.values.end(), "a cost table rates the default of every quality choice");
        QualityCost::Time const& time = cost.on(mBackend);
        const bool isLikeDefault = cost.value == standard || (time.lowRatio <= 1 && time.highRatio >= 1);
        const double ratio = isLikeDefault ? 1 : time.milliseconds / base->on(mBackend).milliseconds;
        return { .picks = { { &effect, &cost } },
                 .nanoseconds = nanosecondsOf(mFrame * (ratio - 1)),
                 .error = std::llround(cost.error * cost.error * kErrorUnits),
                 .changes = cost.value == standard ? 0u : 1u };
    }

    static BudgetOption together(BudgetOption a, BudgetOption const& b) {
        a.picks.insert(a.picks.end(), b.picks.begin(), b.picks.end());
        a.nanoseconds += b.nanoseconds;
        a.error += b.error;
        a.changes += b.changes;
        return a;
    }

    QualityCosts const& mCosts;
    Backend mBackend;
    double mFrame;
    Quality const& mStart;
};

void dropBeaten(std::vector<BudgetPoint>& points) {
    // Options last, which makes the order total: the choice is the same on every machine.
    std::ranges::sort(points, [](BudgetPoint const& a, BudgetPoint const& b) {
        return std::tie(a.nanoseconds, a.error, a.changes, a.options) <
               std::tie(b.nanoseconds, b.error, b.changes, b.options);
    });
    size_t kept = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        // Sorted by time, a point is of use only if its error is below that of all cheaper ones.
        if (kept > 0 && points[i].error >= points[kept - 1].error) continue;
        if (kept != i) points[kept] = std::move(points[i]);
        ++kept;
    }
    points.resize(kept);
}

} // namespace

std::vector<BudgetGroup> budgetGroups(QualityCosts const& costs, Backend backend, double frameMilliseconds,
                                      Quality const& start) {
    return GroupBuilder(costs, backend, frameMilliseconds, start).groups();
}

std::vector<BudgetPoint> paretoPoints(std::vector<BudgetGroup> const& groups, double frameMilliseconds) {
    std::vector<BudgetPoint> points{ { .nanoseconds = nanosecondsOf(frameMilliseconds), .options = {} } };
    for (BudgetGroup const& group : groups) {
        std::vector<BudgetPoint> grown;
        grown.reserve(points.size() * group.options.size());
        for (BudgetPoint const& point : points) {
            for (size_t i = 0; i < group.options.size(); ++i) {
                BudgetOption const& option = group.options[i];
                BudgetPoint next = point;
                next.nanoseconds += option.nanoseconds;
                next.error += option.error;
                next.changes += option.changes;
                next.options.push_back(static_cast<uint16_t>(i));
                grown.push_back(std::move(next));
            }
        }
        dropBeaten(grown);
        points = std::move(grown);
    }
    return points;
}

double millisecondsOf(int64_t nanoseconds) { return static_cast<double>(nanoseconds) / kNanosecondsPerMillisecond; }

double errorOf(int64_t squared) { return std::sqrt(static_cast<double>(squared) / kErrorUnits); }

} // namespace filament_core::engine
