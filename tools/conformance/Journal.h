// SPDX-License-Identifier: Apache-2.0
/// Journal: what a run has done so far, one line of JSON at a time, for whoever started it and must know in which case
/// it died. --journal FILE writes one.
///   Lines   {"devices": {...}} first; {"begins": NAME} and then the case's result for each case.
///   Thread  one.
///   Fails   a file that cannot be written stays short; the reader takes that for a run that did not get far. A last
///           line that was cut off is not there.
#pragma once

#include "tools/conformance/Results.h"

#include <fstream>

namespace filament::conformance {

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

/// No file: nothing has happened.
JournalContents readJournal(std::filesystem::path const& file);

} // namespace filament::conformance
