// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Results.h"

#include "toolkit/json/JsonFile.h"
#include "toolkit/mutations/Mutations.h"
#include "tools/conformance/Machines.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace filament_core::conformance {
namespace {

constexpr std::string_view kMachinePrefix = "machine ";
constexpr const char* kBetweenHashAndPlace = " ";

Json toJson(Comparison const& c) {
    Json json{ { "configuration", c.configuration },
               { "passed", c.passed },
               { "differing", c.differing },
               { "maxDifference", c.maxDifference } };
    if (c.flipMean >= 0) json["flipMean"] = c.flipMean, json["flipP99"] = c.flipP99;
    if (!c.first.empty()) json["first"] = c.first;
    if (!c.image.empty()) json["image"] = c.image, json["difference"] = c.difference;
    if (!c.fault.empty()) json["fault"] = c.fault;
    return json;
}

Comparison comparisonFromJson(Json const& json) {
    return { .configuration = json.at("configuration"),
             .passed = json.at("passed"),
             .differing = json.at("differing"),
             .maxDifference = json.at("maxDifference"),
             .flipMean = json.value("flipMean", -1.0),
             .flipP99 = json.value("flipP99", -1.0),
             .first = json.value("first", ""),
             .image = json.value("image", ""),
             .difference = json.value("difference", ""),
             .fault = json.value("fault", "") };
}

AttachmentHash attachmentFromText(std::string const& text) {
    const size_t end = std::min(text.find(kBetweenHashAndPlace), text.size());
    return { text.substr(0, end), text.substr(std::min(end + 1, text.size())) };
}

Status statusFromJson(std::string const& text) {
    for (const Status status : { Status::Passed, Status::Skipped }) {
        if (text == toString(status)) return status;
    }
    return Status::Failed;
}

Json machinesToJson(Results const& results) {
    Json json = Json::object();
    for (auto const& [name, device] : results.machines) {
        const MachineSummary summary = summaryOf(results, name);
        SimulatedMachine const* machine = findMachine(name);
        json[name] = { { "device", device },
                       { "sameBitsPromised", machine && machine->sameBits },
                       { "cases", summary.cases },
                       { "identical", summary.identical },
                       { "differing", summary.differing },
                       { "differingPixels", summary.differingPixels },
                       { "faults", summary.faults } };
    }
    return json;
}

Json toJson(ShardContents const& contents) {
    return { { "index", contents.shard.index }, { "count", contents.shard.count }, { "cases", contents.cases } };
}

/// Throws Json::exception. Nonsense is refused by merge().
ShardContents shardFromJson(Json const& json) {
    return { { json.at("index").get<uint32_t>(), json.at("count").get<uint32_t>() }, json.at("cases").get<uint32_t>() };
}

Result<void> checkShards(std::vector<Results> const& parts) {
    std::vector<tools::Shard> shards;
    for (Results const& part : parts) {
        if (!part.shard) continue;
        auto const& [index, count] = part.shard->shard;
        if (part.cases.size() != part.shard->cases)
            return fail(ErrorCode::InvalidArgument, "shard {}/{} has {} of {} cases; run it again", index, count,
                        part.cases.size(), part.shard->cases);
        shards.push_back(part.shard->shard);
    }
    return tools::checkComplete(std::move(shards));
}

} // namespace

std::string machineConfiguration(std::string_view machine) { return fmt::format("{}{}", kMachinePrefix, machine); }

std::string_view machineOf(Comparison const& comparison) {
    const std::string_view name = comparison.configuration;
    return name.starts_with(kMachinePrefix) ? name.substr(kMachinePrefix.size()) : std::string_view();
}

Json toJson(CaseResult const& result) {
    Json json{ { "name", result.name }, { "status", toString(result.status) } };
    if (!result.reasons.empty()) json["reasons"] = result.reasons;
    if (result.status == Status::Skipped) return json;
    json["hash"] = result.hash;
    json["baseline"] = result.baseline;
    json["image"] = result.image;
    json["attachments"] = Json::array(); // a text each: one line of the file
    for (auto const& [hash, where] : result.attachments)
        json["attachments"].push_back(hash + kBetweenHashAndPlace + where);
    json["comparisons"] = Json::array();
    for (Comparison const& comparison : result.comparisons) json["comparisons"].push_back(toJson(comparison));
    json["kills"] = Json::array();
    for (Kill const& kill : result.kills)
        json["kills"].push_back(
                { { "mutation", kill.mutation }, { "caught", kill.caught }, { "differing", kill.differing } });
    return json;
}

CaseResult caseFromJson(Json const& json) {
    CaseResult result{ .name = json.at("name"), .status = statusFromJson(json.at("status")) };
    result.reasons = json.value("reasons", std::vector<std::string>());
    result.hash = json.value("hash", "");
    result.baseline = json.value("baseline", "");
    result.image = json.value("image", "");
    for (Json const& attachment : json.value("attachments", Json::array()))
        result.attachments.push_back(attachmentFromText(attachment));
    for (Json const& comparison : json.value("comparisons", Json::array()))
        result.comparisons.push_back(comparisonFromJson(comparison));
    for (Json const& kill : json.value("kills", Json::array()))
        result.kills.push_back({ kill.at("mutation"), kill.at("caught"), kill.at("differing") });
    return result;
}

const char* toString(Status status) {
    switch (status) {
    case Status::Passed:
        return "passed";
    case Status::Failed:
        return "failed";
    case Status::Skipped:
        return "skipped";
    }
    return "failed";
}

Summary summaryOf(Results const& results) {
    Summary summary;
    for (CaseResult const& result : results.cases) {
        summary.passed += result.status == Status::Passed;
        summary.failed += result.status == Status::Failed;
        summary.skipped += result.status == Status::Skipped;
        for (Kill const& kill : result.kills) {
            if (isControl(kill.mutation)) continue;
            ++summary.mutants;
            summary.caught += kill.caught;
        }
        for (Comparison const& comparison : result.comparisons) {
            ++summary.comparisons;
            summary.identical += comparison.isIdentical();
        }
    }
    return summary;
}

MachineSummary summaryOf(Results const& results, std::string_view machine) {
    MachineSummary summary;
    for (CaseResult const& result : results.cases) {
        for (Comparison const& comparison : result.comparisons) {
            if (machineOf(comparison) != machine) continue;
            ++summary.cases;
            summary.identical += comparison.isIdentical();
            summary.faults += !comparison.fault.empty();
            summary.differing += comparison.fault.empty() && comparison.differing > 0;
            summary.differingPixels += comparison.differing;
        }
    }
    return summary;
}

Json toJson(Results const& results) {
    const Summary summary = summaryOf(results);
    Json json;
    if (results.shard) json["shard"] = toJson(*results.shard);
    json["build"] = results.build, json["reference"] = results.reference;
    for (auto const& [backend, device] : results.devices) json["devices"][backend] = device;
    if (!results.machines.empty()) json["machines"] = machinesToJson(results);
    json["summary"] = { { "passed", summary.passed },       { "failed", summary.failed },
                        { "skipped", summary.skipped },     { "comparisons", summary.comparisons },
                        { "identical", summary.identical }, { "mutants", summary.mutants },
                        { "caught", summary.caught } };
    json["cases"] = Json::array();
    for (CaseResult const& result : results.cases) json["cases"].push_back(toJson(result));
    return json;
}

Result<void> writeResults(std::filesystem::path const& folder, Results const& results) {
    if (Result<void> written = writeJson(folder / "results.json", toJson(results)); !written) return written;
    return writeJson(folder / "times.json", Json(results.seconds));
}

Result<Results> readResults(std::filesystem::path const& folder) {
    std::filesystem::path file = folder / "results.json"; // being read
    try {
        const Result<Json> json = readJson(file);
        if (!json) return json.error();
        Results results{ .build = json->at("build"), .reference = json->at("reference") };
        if (json->contains("shard")) results.shard = shardFromJson(json->at("shard"));
        results.devices = json->value("devices", std::map<std::string, std::string>());
        const Json machines = json->value("machines", Json::object());
        for (auto const& [name, machine] : machines.items()) results.machines[name] = machine.at("device");
        for (Json const& one : json->at("cases")) results.cases.push_back(caseFromJson(one));
        file = folder / "times.json";
        const Result<Json> times = readJson(file);
        if (!times) return times.error();
        results.seconds = times->get<std::map<std::string, double>>();
        return results;
    } catch (Json::exception const& error) {
        return fail(ErrorCode::Corrupt, "{}: {}", file.string(), error.what());
    }
}

Result<Results> merge(std::vector<Results> parts) {
    if (const Result<void> complete = checkShards(parts); !complete) return complete.error();
    Results all;
    for (Results& part : parts) {
        if (all.build.empty()) all.build = part.build, all.reference = part.reference;
        if (part.build != all.build || part.reference != all.reference)
            return fail(ErrorCode::InvalidArgument,
                        "results of build '{}' ({}) cannot be merged with those of '{}' ({})", part.build,
                        part.reference, all.build, all.reference);
        for (auto const& [backend, device] : part.devices) {
            const auto [known, isNew] = all.devices.emplace(backend, device);
            if (!isNew && known->second != device)
                return fail(ErrorCode::InvalidArgument, "results of '{}' cannot be merged with those of '{}'", device,
                            known->second);
        }
        all.machines.merge(part.machines);
        std::move(part.cases.begin(), part.cases.end(), std::back_inserter(all.cases));
        all.seconds.merge(part.seconds);
    }
    std::sort(all.cases.begin(), all.cases.end(), [](auto const& a, auto const& b) { return a.name < b.name; });
    const auto twice = std::adjacent_find(all.cases.begin(), all.cases.end(),
                                          [](auto const& a, auto const& b) { return a.name == b.name; });
    if (twice != all.cases.end())
        return fail(ErrorCode::InvalidArgument, "case '{}' is in two of the results; merge each shard once",
                    twice->name);
    return all;
}

} // namespace filament_core::conformance
