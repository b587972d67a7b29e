// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Journal.h"

#include "toolkit/json/JsonFile.h"

#include <nlohmann/json.hpp>

namespace filament_core::conformance {
namespace {

void read(Json const& line, JournalContents& contents) {
    if (line.contains("devices")) {
        contents.devices = line.at("devices").get<std::map<std::string, std::string>>();
    } else if (line.contains("begins")) {
        contents.open = line.at("begins");
    } else {
        contents.cases.push_back(caseFromJson(line));
        contents.open.clear();
    }
}

} // namespace

Journal::Journal(std::filesystem::path const& file) {
    if (!file.empty()) mFile.open(file, std::ios::trunc);
}

void Journal::line(Json const& json) {
    if (mFile.is_open()) mFile << json.dump() << std::endl; // flush now: the process may crash in the next step
}

void Journal::devices(std::map<std::string, std::string> const& devices) { line({ { "devices", devices } }); }
void Journal::begins(std::string const& name) { line({ { "begins", name } }); }
void Journal::ends(CaseResult const& result) { line(toJson(result)); }

JournalContents readJournal(std::filesystem::path const& file) {
    JournalContents contents;
    std::ifstream lines(file);
    for (std::string text; std::getline(lines, text);) {
        const Result<Json> line = tools::parseJson(text, {});
        if (!line || !line->is_object()) break;
        try {
            read(*line, contents);
        } catch (Json::exception const&) {
            break;
        }
    }
    return contents;
}

} // namespace filament_core::conformance
