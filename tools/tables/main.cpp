// SPDX-License-Identifier: Apache-2.0
// filament-tables [--write] FILE...: the tables of documents, made from those that the programs read. Exit status 0:
// all are current, or were written. 1: some are not, or a file is at fault.
#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/program/CommandLine.h"
#include "toolkit/program/Program.h"
#include "tools/tables/Tables.h"

#include <filament_core/SceneFile.h>

#include <cstdio>

namespace filament_core::tools {
namespace {

/// The JSON schema of scene files is one as a whole.
constexpr std::string_view kSchema = "scene-file.schema.json";

/// True: the file has the current tables.
Result<bool> update(std::string const& path, std::vector<NamedTable> const& tables, bool writes) {
    constexpr size_t kLargest = 16 << 20; // bytes
    const Result<std::string> text = assets::readText(path, kLargest);
    if (!text) return text.error();
    const Result<std::string> current = path.ends_with(kSchema) ? SceneFile::schema() : withTables(*text, tables, path);
    if (!current) return current.error();
    if (*current == *text) return true;
    if (!writes) return false;
    if (const Result<void> done = assets::replaceFile(path, std::as_bytes(std::span(*current))); !done)
        return done.error();
    std::printf("%s: written\n", path.c_str());
    return true;
}

int run(std::vector<std::string> const& files, bool writes) {
    const std::vector<NamedTable> tables = documentTables();
    int status = 0;
    for (std::string const& file : files) {
        const Result<bool> current = update(file, tables, writes);
        if (!current) return failed(current.error());
        if (*current) continue;
        std::printf("%s: its tables are not current: run filament-tables --write %s\n", file.c_str(), file.c_str());
        status = 1;
    }
    return status;
}

} // namespace
} // namespace filament_core::tools

int main(int argc, char** argv) {
    using namespace filament_core;
    tools::setProgramName("filament-tables");
    tools::routeLogToConsole();
    tools::CommandLine app("Checks or writes the tables of documents.", "filament-tables");
    std::vector<std::string> files;
    bool writes = false;
    app.flag("--write", writes, "write the tables that are not current");
    app.option("FILE", files, "documents").required();
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return tools::failed(parsed.error());
    const int status = *parsed ? tools::run(files, writes) : 0;
    const Result<void> printed = tools::finishOutput();
    return printed ? status : tools::failed(printed.error());
}
