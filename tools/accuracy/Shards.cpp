// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Shards.h"

#include "base/Suggest.h"
#include "toolkit/json/JsonFile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace filament_core::accuracy {
namespace {

using tools::Json;
namespace fs = std::filesystem;

/// What shards of one run have in common.
constexpr std::array kCommon{ "program", "version", "driver", "commit", "frame", "size", "rounds" };

struct Data {
    fs::path file;
    Json json;
    tools::Shard shard;
    std::vector<std::string> rows; ///< of the whole run
};

/// Throws Json::exception.
Data dataOf(fs::path const& file, Json json) {
    Json const& shard = json.at("shard");
    Data data{ .file = file, .json = json };
    data.shard = { shard.at("index").get<uint32_t>(), shard.at("count").get<uint32_t>() };
    data.rows = shard.at("rows").get<std::vector<std::string>>();
    for (const char* name : kCommon) json.at(name);
    for (const char* name : { "machine", "date" }) json.at(name).get<std::string>();
    for (const char* list : { "effects", "skipped" })
        for (Json const& row : json.at(list)) row.at("name").get<std::string>();
    csvOf(json); // every value has its numbers
    return data;
}

Result<Data> read(fs::path const& given) {
    const fs::path file = fs::is_directory(given) ? given / "results.json" : given;
    const Result<Json> json = tools::readJson(file);
    if (!json) return json.error();
    if (!json->is_object()) return fail(ErrorCode::Corrupt, "{}: no JSON object; run this shard again", file.string());
    if (!json->contains("shard"))
        return fail(ErrorCode::InvalidArgument, "{}: not of a shard; give the results of runs with --shard",
                    file.string());
    try {
        return dataOf(file, *json);
    } catch (Json::exception const& error) {
        return fail(ErrorCode::Corrupt, "{}: {}; run this shard again", file.string(), error.what());
    }
}

Result<void> checkSame(Data const& a, Data const& b) {
    for (const char* name : kCommon) {
        if (a.json.at(name) == b.json.at(name)) continue;
        return fail(ErrorCode::InvalidArgument, "{} and {} differ in their {}: {} and {}; measure all shards alike",
                    a.file.string(), b.file.string(), name, a.json.at(name).dump(), b.json.at(name).dump());
    }
    if (a.rows == b.rows) return {};
    return fail(ErrorCode::InvalidArgument, "{} and {} are of runs with other rows; give all the same --effect",
                a.file.string(), b.file.string());
}

Result<void> checkAll(std::vector<Data> const& shards) {
    std::vector<tools::Shard> numbers;
    for (Data const& data : shards) {
        if (const Result<void> same = checkSame(data, shards.front()); !same) return same;
        numbers.push_back(data.shard);
    }
    return tools::checkComplete(std::move(numbers));
}

Json const* findRow(std::vector<Data> const& shards, const char* list, std::string const& name) {
    for (Data const& data : shards) {
        for (Json const& row : data.json.at(list))
            if (row.at("name") == name) return &row;
    }
    return nullptr;
}

/// Each machine once; its load only if all shards say the same.
std::string machinesOf(std::vector<Data> const& shards) {
    std::vector<std::string> texts, machines;
    const auto add = [](std::vector<std::string>& list, std::string const& text) {
        if (std::ranges::find(list, text) == list.end()) list.push_back(text);
    };
    for (Data const& data : shards) {
        const std::string text = data.json.at("machine");
        add(texts, text);
        add(machines, text.substr(0, text.find(", load ")));
    }
    if (texts.size() == 1) return texts.front();
    return fmt::format("{}", fmt::join(machines, "; "));
}

} // namespace

Result<std::vector<std::string>> rowsOf(std::vector<Effect> const& table, std::vector<std::string> const& chosen) {
    for (std::string const& name : chosen) {
        if (std::ranges::find(table, name, &Effect::name) == table.end())
            return fail(ErrorCode::NotFound, "there is no effect '{}'{}", name, suggestion(name, namesOf(table)));
    }
    if (!chosen.empty()) return chosen;
    std::vector<std::string> all;
    for (Effect const& effect : table) all.push_back(effect.name);
    return all;
}

Result<std::vector<std::string>> rowsOf(tools::Shard const& shard, std::vector<std::string> const& rows) {
    std::vector<std::string> mine;
    for (size_t i = shard.index; i < rows.size(); i += shard.count) mine.push_back(rows[i]);
    if (!mine.empty()) return mine;
    return fail(ErrorCode::InvalidArgument, "--shard {}/{} has no row, for there are {}; give at most {} shards",
                shard.index, shard.count, rows.size(), rows.size());
}

Result<void> writeShard(Results const& results, tools::Shard const& shard, std::vector<std::string> const& rows,
                        fs::path const& out) {
    Json json = jsonOf(results);
    json["shard"] = { { "index", shard.index }, { "count", shard.count }, { "rows", rows } };
    return tools::writeJson(out / "results.json", json, 1);
}

Result<Json> mergeShards(std::vector<fs::path> const& files) {
    std::vector<Data> shards;
    for (fs::path const& file : files) {
        Result<Data> data = read(file);
        if (!data) return data.error();
        shards.push_back(std::move(*data));
    }
    if (shards.empty())
        return fail(ErrorCode::InvalidArgument, "there is nothing to merge; give the folders of shards");
    if (const Result<void> checked = checkAll(shards); !checked) return checked.error();
    std::ranges::sort(shards, {}, [](Data const& data) { return data.shard.index; });
    Json merged = shards.front().json;
    merged.erase("shard");
    merged["machine"] = machinesOf(shards);
    for (Data const& data : shards) merged["date"] = std::max<std::string>(merged["date"], data.json.at("date"));
    merged["effects"] = Json::array(), merged["skipped"] = Json::array();
    for (std::string const& name : shards.front().rows) {
        Json const *effect = findRow(shards, "effects", name), *skipped = findRow(shards, "skipped", name);
        if (!effect && !skipped)
            return fail(ErrorCode::InvalidArgument, "no shard has row {}; run the shards again", name);
        merged[effect ? "effects" : "skipped"].push_back(effect ? *effect : *skipped);
    }
    return merged;
}

} // namespace filament_core::accuracy
