// SPDX-License-Identifier: Apache-2.0
/// Results: the findings of a run, as plain values and as results.json. Shards of one run merge to the same file that
/// the whole run would have written: nothing in it depends on the time or order of cases (times are in times.json
/// beside it). The results of one shard also say which shard they are; merged results do not.
///   Fails   readResults: Unreadable or Corrupt with the path. merge: InvalidArgument if runs do not belong together,
///           or if a shard is missing, there twice or unfinished; the message names it and what to do.
///   Thread  any; pure except for files.
#pragma once

#include "toolkit/json/JsonReader.h"
#include "toolkit/program/Shard.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::conformance {

using namespace tools; // the toolkit

enum class Status : uint8_t { Passed, Failed, Skipped };
const char* toString(Status status);

/// One picture of a case compared with the reference picture of that case.
struct Comparison {
    std::string configuration; ///< "gles", "vulkan workers 8", "machine width-128"
    bool passed = false;
    uint64_t differing = 0;             ///< pixels whose bits differ
    uint32_t maxDifference = 0;         ///< in 1/255
    double flipMean = -1, flipP99 = -1; ///< -1: not requested
    std::string first;                  ///< the first differing pixel, with its command-stream position; empty: none
    std::string image, difference;      ///< files in the folder of the results; empty: equal
    std::string fault;                  ///< why there is no picture, or what is wrong with it; empty: nothing

    bool isIdentical() const { return differing == 0 && fault.empty(); }
};

/// For a comparison with a picture that a child process drew (Machines.h): converts its name to the configuration and
/// back.
std::string machineConfiguration(std::string_view machine);
std::string_view machineOf(Comparison const& comparison); ///< empty: this process drew it

struct Kill {
    std::string mutation;
    bool caught = false;
    uint64_t differing = 0; ///< pixels
};

/// The bits of an attachment after a pass of the reference configuration.
struct AttachmentHash {
    std::string hash;
    std::string where; ///< "pass 'color', color 0", "pass 'shadow maps', depth"
    friend bool operator==(AttachmentHash const&, AttachmentHash const&) = default;
};

struct CaseResult {
    std::string name;
    Status status = Status::Failed;
    std::vector<std::string> reasons;        ///< why it failed or was skipped
    std::string hash;                        ///< of the reference picture
    std::string baseline;                    ///< the result of the comparison with the stored picture
    std::string image;                       ///< of the reference configuration
    std::vector<AttachmentHash> attachments; ///< in the order of the passes
    std::vector<Comparison> comparisons;
    std::vector<Kill> kills;
};

/// What the results of one shard should hold.
struct ShardContents {
    tools::Shard shard{};
    uint32_t cases = 0; ///< an interrupted run has fewer
};

struct Results {
    std::optional<ShardContents> shard{};        ///< none: a whole run, or merged
    std::string build;                           ///< "Release"
    std::string reference;                       ///< configuration that the others are compared with
    std::map<std::string, std::string> devices;  ///< backend -> device and driver
    std::map<std::string, std::string> machines; ///< simulated machine -> device that its processes found
    std::vector<CaseResult> cases;               ///< ascending by name
    std::map<std::string, double> seconds;       ///< by case
};

struct Summary {
    uint32_t passed = 0, failed = 0, skipped = 0;
    uint32_t mutants = 0, caught = 0; ///< pairs of a case and a mutation that it must notice
    uint64_t comparisons = 0, identical = 0;
};
Summary summaryOf(Results const& results);

/// A summary of the cases for one simulated machine.
struct MachineSummary {
    uint32_t cases = 0, identical = 0, differing = 0, faults = 0; ///< faults are not among the differing
    uint64_t differingPixels = 0;
};
MachineSummary summaryOf(Results const& results, std::string_view machine);

Json toJson(CaseResult const& result);
CaseResult caseFromJson(Json const& json); ///< throws Json::exception
Json toJson(Results const& results);
Result<void> writeResults(std::filesystem::path const& folder, Results const& results);
Result<Results> readResults(std::filesystem::path const& folder);
/// All cases of all parts; a case may be in only one part. Parts that say which shard they are must be all shards of
/// one run.
Result<Results> merge(std::vector<Results> parts);

} // namespace filament_core::conformance
