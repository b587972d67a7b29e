// SPDX-License-Identifier: Apache-2.0
#include <filament_core/QualityBudget.h>

#include "base/Assert.h"
#include "base/Result.h"
#include "filament_core/engine/quality/QualityKnapsack.h"

#include <filament_core/Options.h>

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

using engine::BudgetGroup;
using engine::BudgetOption;
using engine::BudgetPoint;
using engine::errorOf;
using engine::millisecondsOf;
using Groups = std::vector<BudgetGroup>;

Result<void> check(QualityBudget const& budget, QualityCosts const& costs) {
    if (!std::isfinite(budget.gpuMilliseconds) || budget.gpuMilliseconds <= 0) {
        return fail(ErrorCode::InvalidArgument, "a budget of {} ms: give a number above 0", budget.gpuMilliseconds);
    }
    if (budget.size.x == 0 || budget.size.y == 0) {
        return fail(ErrorCode::InvalidArgument, "a budget for {} x {} pixels: give the size of the frame",
                    budget.size.x, budget.size.y);
    }
    if (!std::isfinite(budget.frameMilliseconds) || budget.frameMilliseconds < 0) {
        return fail(ErrorCode::InvalidArgument, "a frame of {} ms: give what was measured, or 0",
                    budget.frameMilliseconds);
    }
    if (costs.size.x == 0 || costs.size.y == 0 || !(costs.frameMilliseconds(budget.backend) > 0)) {
        return fail(ErrorCode::InvalidArgument, "the cost table of '{}' has no times for {}; measure them",
                    costs.machine, toString(budget.backend));
    }
    return {};
}

double frameMilliseconds(QualityBudget const& budget, QualityCosts const& costs) {
    if (budget.frameMilliseconds > 0) return budget.frameMilliseconds;
    const double pixels = double(budget.size.x) * budget.size.y, measured = double(costs.size.x) * costs.size.y;
    return costs.frameMilliseconds(budget.backend) * (pixels / measured);
}

BudgetOption const& optionOf(Groups const& groups, BudgetPoint const& point, size_t group) {
    return groups[group].options[point.options[group]];
}

Quality qualityOf(Groups const& groups, BudgetPoint const& point, Quality quality) {
    for (size_t i = 0; i < groups.size(); ++i) {
        for (BudgetOption::Pick const& pick : optionOf(groups, point, i).picks) {
            const Result<void> set = setOption(quality, pick.effect->name, pick.cost->value);
            FILAMENT_ASSERT(set.ok(), "a cost table rates values of quality choices");
        }
    }
    return quality;
}

/// "table dfgTableSize=64": the value, then the values that depend on it.
std::string valueText(BudgetOption const& option) {
    std::string text = option.picks.front().cost->value;
    for (size_t i = 1; i < option.picks.size(); ++i)
        text += fmt::format(" {}={}", option.picks[i].effect->name, option.picks[i].cost->value);
    return text;
}

/// The steps from one point to another, ordered by the error that they save per time.
std::vector<QualityStep> stepsBetween(Groups const& groups, BudgetPoint const& from, BudgetPoint const& to) {
    struct Change {
        BudgetOption const *from, *to;
        double rank = 0; // decrease of squared error per nanosecond
    };
    std::vector<Change> changes;
    for (size_t i = 0; i < groups.size(); ++i) {
        BudgetOption const &before = optionOf(groups, from, i), &after = optionOf(groups, to, i);
        if (&before == &after) continue;
        const auto cost = static_cast<double>(std::max<int64_t>(after.nanoseconds - before.nanoseconds, 1));
        changes.push_back({ &before, &after, static_cast<double>(before.error - after.error) / cost });
    }
    std::ranges::stable_sort(changes, std::ranges::greater{}, &Change::rank);
    std::vector<QualityStep> steps;
    int64_t error = from.error;
    for (Change const& change : changes) {
        const int64_t before = error;
        error += change.to->error - change.from->error;
        steps.push_back({ .name = change.to->picks.front().effect->name,
                          .from = valueText(*change.from),
                          .to = valueText(*change.to),
                          .milliseconds = millisecondsOf(change.to->nanoseconds - change.from->nanoseconds),
                          .errorBefore = errorOf(before),
                          .errorAfter = errorOf(error) });
    }
    return steps;
}

std::string percent(double error) { return fmt::format("{:.3g} %", error * 100); }

std::string stepLine(QualityStep const& step) {
    return fmt::format("  {:+8.3f} ms  {} {} -> {}: error {} -> {}\n", step.milliseconds, step.name, step.from, step.to,
                       percent(step.errorBefore), percent(step.errorAfter));
}

std::string explain(QualityBudget const& budget, QualityCosts const& costs, QualityDecision const& decision,
                    BudgetPoint const& cheapest) {
    std::string text = fmt::format("budget {:.3f} ms for {} x {} on {}: predicted {:.3f} ms, error {}\n",
                                   budget.gpuMilliseconds, budget.size.x, budget.size.y, toString(budget.backend),
                                   decision.predicted.milliseconds, percent(decision.predicted.error));
    text += fmt::format("setting: {}\n", toString(decision.quality));
    text += fmt::format("measured on {}, {}, at {} x {}{}\n", costs.machine, costs.driver, costs.size.x, costs.size.y,
                        budget.frameMilliseconds > 0 ? fmt::format("; a frame here takes {:.3f} ms with the default",
                                                                   budget.frameMilliseconds)
                                                     : "");
    if (!decision.fits) text += "over the budget: nothing cheaper is in the table\n";
    text += fmt::format("cheapest setting: {:.3f} ms, error {}; bought beyond it:\n",
                        millisecondsOf(cheapest.nanoseconds), percent(errorOf(cheapest.error)));
    if (decision.steps.empty()) text += "  nothing\n";
    for (QualityStep const& step : decision.steps) text += stepLine(step);
    if (decision.nextSteps.empty()) return text + "nothing better is in the table at any price\n";
    text += fmt::format("next better setting: {:.3f} ms, error {}:\n", decision.next.milliseconds,
                        percent(decision.next.error));
    for (QualityStep const& step : decision.nextSteps) text += stepLine(step);
    return text;
}

QualityPrediction predictionOf(BudgetPoint const& point) {
    return { std::max(millisecondsOf(point.nanoseconds), 0.0), errorOf(point.error) };
}

} // namespace

Result<QualityDecision> chooseQuality(QualityBudget const& budget, QualityCosts const& costs, Quality const& start) {
    if (const Result<void> checked = check(budget, costs); !checked) return checked.error();
    const double frame = frameMilliseconds(budget, costs);
    const Groups groups = engine::budgetGroups(costs, budget.backend, frame, start);
    const std::vector<BudgetPoint> points = engine::paretoPoints(groups, frame);
    const auto over = std::ranges::find_if(points, [&](BudgetPoint const& point) {
        return millisecondsOf(point.nanoseconds) > budget.gpuMilliseconds;
    });
    const bool fits = over != points.begin();
    const auto chosen = fits ? over - 1 : over;

    QualityDecision decision;
    decision.quality = qualityOf(groups, *chosen, start);
    decision.predicted = predictionOf(*chosen);
    decision.fits = fits;
    decision.steps = stepsBetween(groups, points.front(), *chosen);
    if (const auto next = chosen + 1; next != points.end()) {
        decision.nextSteps = stepsBetween(groups, *chosen, *next);
        decision.next = predictionOf(*next);
    }
    decision.explanation = explain(budget, costs, decision, points.front());
    return decision;
}

Result<QualityPrediction> predictQuality(Quality const& quality, QualityBudget const& budget,
                                         QualityCosts const& costs) {
    if (const Result<void> checked = check(budget, costs); !checked) return checked.error();
    const double frame = frameMilliseconds(budget, costs);
    const auto isSet = [&](BudgetOption::Pick const& pick) {
        return optionValue(quality, pick.effect->name) == pick.cost->value;
    };
    BudgetPoint point = engine::paretoPoints({}, frame).front();
    for (BudgetGroup const& group : engine::budgetGroups(costs, budget.backend, frame, quality)) {
        const auto found = std::ranges::find_if(
                group.options, [&](BudgetOption const& option) { return std::ranges::all_of(option.picks, isSet); });
        if (found == group.options.end()) {
            std::string const& name = group.options.front().picks.front().effect->name;
            return fail(ErrorCode::InvalidArgument, "the cost table of '{}' does not rate {}={}", costs.machine, name,
                        *optionValue(quality, name));
        }
        point.nanoseconds += found->nanoseconds;
        point.error += found->error;
    }
    return predictionOf(point);
}

} // namespace filament_core
