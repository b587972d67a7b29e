// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/MutantRun.h"

#include "tools/conformance/Compare.h"

#include <fmt/format.h>

namespace filament_core::conformance {
namespace {

constexpr std::string_view kCure = "let it change what the case draws with, or take it out of the scene's \"kills\"";

std::string titleOf(Mutation const& mutation) { return fmt::format("'{}' ({})", mutation.name, mutation.what); }

struct Drawn {
    Shot shot;
    Comparison comparison;
};

Result<Drawn> drawBeside(Image const& reference, Stage& stage, SceneSpec const& spec) {
    if (const Result<void> set = stage.set(spec); !set) return set.error();
    Result<Shot> shot = stage.shoot();
    if (!shot) return shot.error();
    Result<Comparison> compared = comparePictures(reference, shot->image, spec.comparator);
    if (!compared) return compared.error();
    return Drawn{ std::move(*shot), std::move(*compared) };
}

/// Whether draws read it: if so, they show it where it is exaggerated.
Result<std::string> faultOfUnnoticed(Mutation const& mutation, StageOptions const& options, SceneSpec const& spec,
                                     Image const& reference, DefectReach const& reach) {
    if (std::string why = whyUndrawn(mutation, reach); !why.empty()) return why;
    if (!reach.hasNumbers)
        return fmt::format("{} was not noticed, though draws have {}", titleOf(mutation), reach.changed);
    auto stage = Stage::open(options, mutation.make(), DefectSize::Exaggerated);
    if (!stage) return stage.error();
    const Result<Drawn> drawn = drawBeside(reference, **stage, spec);
    if (!drawn) return drawn.error();
    if (drawn->comparison.differing == 0)
        return fmt::format("{} proves nothing: no draw reads what it changes in {}; {}", titleOf(mutation),
                           reach.changed, kCure);
    return fmt::format("{} was not noticed, though draws read what it changes in {}", titleOf(mutation), reach.changed);
}

} // namespace

std::string whyUndrawn(Mutation const& mutation, DefectReach const& reach) {
    if (reach.changed.empty())
        return fmt::format("{} proves nothing: no command has what it changes; {}", titleOf(mutation), kCure);
    if (!reach.isDrawn)
        return fmt::format("{} proves nothing: no draw has what it changes, {}; {}", titleOf(mutation), reach.changed,
                           kCure);
    return {};
}

Result<MutantVerdict> runMutant(Mutation const& mutation, StageOptions const& options, SceneSpec const& spec,
                                Image const& reference) {
    const auto stage = Stage::open(options, mutation.make());
    if (!stage) return stage.error();
    Result<Drawn> drawn = drawBeside(reference, **stage, spec);
    if (!drawn) return drawn.error();
    const bool caught = !drawn->comparison.passed;
    MutantVerdict verdict{ .kill = Kill{ std::string(mutation.name), caught, drawn->comparison.differing },
                           .errors = std::move(drawn->shot.errors),
                           .fault = {} };
    const DefectReach reach = (*stage)->reach();
    if (isControl(mutation.name)) {
        if (caught) verdict.fault = fmt::format("'{}' draws a different picture", mutation.name);
        if (!caught && mutation.name != kNoDefect && !reach.isDrawn) verdict.kill.reset(); // no scene claims it
    } else if (!caught) {
        Result<std::string> fault = faultOfUnnoticed(mutation, options, spec, reference, reach);
        if (!fault) return fault.error();
        verdict.fault = std::move(*fault);
    }
    return verdict;
}

} // namespace filament_core::conformance
