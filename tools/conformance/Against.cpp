// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Against.h"

#include "tools/conformance/Compare.h"

#include <algorithm>

namespace filament_core::conformance {
namespace {

namespace fs = std::filesystem;

/// "first in pass, attachment", or that all of them agree; empty if one of the reports has none.
std::string firstPass(CaseResult const& mine, CaseResult const& theirs) {
    if (mine.attachments.empty() || theirs.attachments.empty()) return {};
    const auto [at, other] = std::ranges::mismatch(mine.attachments, theirs.attachments);
    if (at == mine.attachments.end() && other == theirs.attachments.end()) return "after the last pass";
    if (at == mine.attachments.end()) return fmt::format("in {}, which only the other report has", other->where);
    if (other == theirs.attachments.end()) return fmt::format("in {}, which only this run has", at->where);
    if (at->where == other->where) return fmt::format("first in {}", at->where);
    return fmt::format("from {} on, where the other report has {}", at->where, other->where);
}

std::string whatDiffers(Comparison const& comparison) {
    std::string text = comparison.fault;
    if (text.empty())
        text = fmt::format("{} pixels differ, by {}/255 at most", comparison.differing, comparison.maxDifference);
    return comparison.first.empty() ? text : text + ", " + comparison.first;
}

/// Of a case whose hashes differ.
Comparison differenceOf(CaseResult const& mine, fs::path const& folder, CaseResult const& theirs,
                        fs::path const& other) {
    Comparison comparison{ .configuration = againstConfiguration(other) };
    const Result<void> compared = mine.image.empty() || theirs.image.empty()
                                          ? fail(ErrorCode::NotFound, "a picture is missing: --pictures all")
                                          : compareFiles(folder, mine.image, other / theirs.image, comparison);
    if (!compared) comparison.fault = fmt::format("other bits ({})", compared.error().message);
    const std::string pass = firstPass(mine, theirs);
    if (!pass.empty()) comparison.first += (comparison.first.empty() ? "" : "; ") + pass;
    return comparison;
}

Comparison const* find(CaseResult const& result, std::string const& configuration) {
    const auto found = std::ranges::find(result.comparisons, configuration, &Comparison::configuration);
    return found == result.comparisons.end() ? nullptr : &*found;
}

} // namespace

std::string againstConfiguration(fs::path const& other) {
    const fs::path name = other.has_filename() ? other.filename() : other.parent_path().filename();
    return "against " + name.string();
}

Result<void> compareWithReport(fs::path const& folder, Results& results, fs::path const& other) {
    const Result<Results> theirs = readResults(other);
    if (!theirs) return theirs.error();
    for (CaseResult& mine : results.cases) {
        const auto found = std::ranges::find(theirs->cases, mine.name, &CaseResult::name);
        const bool isThere = found != theirs->cases.end() && !found->hash.empty();
        if (!isThere || mine.hash.empty()) continue;
        if (mine.hash == found->hash) {
            mine.comparisons.push_back({ .configuration = againstConfiguration(other), .passed = true });
            continue;
        }
        Comparison& comparison = mine.comparisons.emplace_back(differenceOf(mine, folder, *found, other));
        mine.status = Status::Failed;
        mine.reasons.push_back(fmt::format("{}: {}", comparison.configuration, whatDiffers(comparison)));
    }
    return {};
}

std::string againstLine(Results const& results, fs::path const& other) {
    const std::string configuration = againstConfiguration(other);
    size_t compared = 0, same = 0;
    for (CaseResult const& result : results.cases) {
        Comparison const* comparison = find(result, configuration);
        compared += comparison != nullptr;
        same += comparison && comparison->passed;
    }
    return fmt::format("{}: {} of {} cases have the same bits; {} have no picture there\n", configuration, same,
                       compared, results.cases.size() - compared);
}

} // namespace filament_core::conformance
