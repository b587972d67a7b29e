// SPDX-License-Identifier: Apache-2.0
/// The showcase as a document of the viewer, written once for each process.
#pragma once

#include "toolkit/showcase/Showcase.h"
#include "tools/view/app/ViewerOptions.h"
#include "tools/view/document/Document.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

namespace filament_core::view {

inline showcase::Files const& showcaseFiles() {
    static const showcase::Files files = [] {
        jobs::JobSystem jobs({ .workers = 1 });
        const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "viewer-showcase";
        Result<showcase::Files> written = showcase::writeFiles(folder, jobs);
        EXPECT_TRUE(written.ok());
        return *written;
    }();
    return files;
}

inline Document showcaseDocument(uint2 size) {
    Document document = makeDocument({}, showcaseFiles().model, showcaseFiles().environment);
    document.view.size = size;
    return document;
}

/// What a loop does that has nothing to do: a core for the threads that it waits for.
inline void letOthersWork() { std::this_thread::sleep_for(std::chrono::microseconds(200)); }

/// With the checks of all commands.
inline ViewerOptions testOptions(Backend backend) {
    ViewerOptions options;
    options.backend = backend;
    options.workers = 1;
    options.validation = true;
    options.out = std::filesystem::path(testing::TempDir());
    return options;
}

} // namespace filament_core::view
