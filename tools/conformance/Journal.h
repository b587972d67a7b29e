// SPDX-License-Identifier: Apache-2.0
/// Journal: the progress of a run, one line of JSON at a time, so that the parent process can tell in which case the
/// run crashed. --journal FILE writes one.
///   Lines   first {"devices": {...}}; then for each case {"begins": NAME} and its result.
///   Thread  one.
///   Fails   a file that cannot be written stays incomplete, and the reader takes the run for one that ended early. An
///           incomplete last line is ignored.
#pragma once

#include "tools/conformance/Results.h"

#include <fstream>

namespace filament_core::conformance {

class Journal {
public:
    /// An empty path: writes nothing.
    explicit Journal(std::filesystem::path const& file);

    void devices(std::map<std::string, std::string> const& devices);
    void begins(std::string const& name);
    void ends(CaseResult const& result);

private:
    void line(Json const& json);

    std::ofstream mFile;
};

struct JournalContents {
    std::map<std::string, std::string> devices;
    std::vector<CaseResult> cases; ///< that ended
    std::string open;              ///< the case that began and did not end; empty: none
};

/// A missing file is an empty journal.
JournalContents readJournal(std::filesystem::path const& file);

} // namespace filament_core::conformance
