// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/MaterialCost.h"

#include "shaders/compiler/Cost.h"

#include <chrono>
#include <fstream>
#include <sstream>
#include <system_error>

namespace filament_core::view {
namespace {

std::string reportOf(std::filesystem::path const& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) return file.string() + " cannot be read";
    const Result<std::string> report = shader::costReport(text.str(), file.filename().string());
    return report ? *report : report.error().message;
}

} // namespace

bool MaterialCost::has(std::filesystem::path const& file) { return file.extension() == ".mat"; }

bool MaterialCost::poll() {
    if (!isCompiling() || mPending.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    mText = mPending.get();
    return true;
}

void MaterialCost::follow(std::filesystem::path const& file) {
    poll();
    if (isCompiling()) return;
    if (file != mFile) mText.clear();
    if (!has(file)) {
        mFile.clear();
        return;
    }
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error);
    if (error || (file == mFile && time == mTime)) return;
    mFile = file;
    mTime = time;
    mPending = std::async(std::launch::async, reportOf, file);
}

} // namespace filament_core::view
