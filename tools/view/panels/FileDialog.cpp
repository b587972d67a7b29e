// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/FileDialog.h"

#include "tools/view/panels/PanelText.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace filament::view {
namespace {

using namespace std::string_view_literals;

constexpr std::array kOpenEndings{ ".gltf"sv, ".glb"sv,  ".mat"sv,  ".fmat"sv, ".hdr"sv,
                                   ".exr"sv,  ".ktx2"sv, ".fenv"sv, ".json"sv };
constexpr std::array kPathEndings{ ".json"sv };
constexpr std::array kPictureEndings{ ".png"sv, ".exr"sv };
constexpr size_t kRowsOfPage = 10;
constexpr size_t kShownRecent = 5;

const char* titleOf(FilePurpose purpose) {
    constexpr std::array kTitles{ "Open a model, a material, an environment or a document###files",
                                  "Load a camera path###files", "Save the camera path###files",
                                  "Save the picture###files" };
    return kTitles[static_cast<size_t>(purpose)];
}

bool isReady(std::shared_future<FolderList> const& reading) {
    return reading.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

bool isPath(std::string const& text) { return text.find('/') != std::string::npos; }
bool isPressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

} // namespace

bool isSaving(FilePurpose purpose) { return purpose == FilePurpose::SavePath || purpose == FilePurpose::SavePicture; }

std::span<const std::string_view> endingsOf(FilePurpose purpose) {
    switch (purpose) {
    case FilePurpose::Open:
        return kOpenEndings;
    case FilePurpose::SavePicture:
        return kPictureEndings;
    default:
        return kPathEndings;
    }
}

void FileDialog::open(FilePurpose purpose, std::string name) {
    mPurpose = purpose;
    mIsOpen = mIsNew = true;
    mField = std::move(name);
    goTo(mFolder.empty() ? "." : mFolder);
}

void FileDialog::goTo(std::filesystem::path const& folder) {
    std::error_code error;
    std::filesystem::path whole = std::filesystem::absolute(folder, error).lexically_normal();
    if (error) whole = folder;
    if (!whole.has_filename() && whole.has_relative_path()) whole = whole.parent_path(); // "models/" is "models"
    mFolder = whole;
    mList = {}; // its names belong to another folder
    mSelected = 0;
    mHasMoved = true;
    mToReplace.clear();
    if (mReading.valid()) mAbandoned.push_back(std::move(mReading));
    mReading = std::async(std::launch::async, [whole, endings = endingsOf(mPurpose)] {
                   return listFolder(whole, endings);
               }).share();
}

void FileDialog::pollReading() {
    std::erase_if(mAbandoned, isReady);
    if (!mReading.valid() || !isReady(mReading)) return;
    mList = mReading.get();
    mReading = {};
}

void FileDialog::choose(std::filesystem::path const& file) {
    std::error_code ignored;
    if (isSaving(mPurpose) && file != mToReplace && std::filesystem::exists(file, ignored)) {
        mToReplace = file;
        return;
    }
    mChosen = ChosenFile{ mPurpose, file };
    mIsOpen = false;
}

void FileDialog::enterEntry(FolderEntry const& entry) {
    if (!entry.isFolder) return choose(mFolder / entry.name);
    if (!isSaving(mPurpose)) mField.clear();
    goTo(mFolder / entry.name);
}

/// What is written, if it is a path. A name to save to gets an ending.
void FileDialog::enterTyped() {
    if (mField.empty()) return;
    const std::filesystem::path typed = mFolder / mField; // an absolute one takes its place
    std::error_code ignored;
    if (std::filesystem::is_directory(typed, ignored)) {
        mField.clear();
        return goTo(typed);
    }
    if (isSaving(mPurpose)) {
        const std::span<const std::string_view> endings = endingsOf(mPurpose);
        return choose(endsAsAsked(typed.string(), endings)
                              ? typed
                              : std::filesystem::path(typed.string() + std::string(endings.front())));
    }
    if (std::filesystem::is_regular_file(typed, ignored)) choose(typed);
}

void FileDialog::enter(std::vector<size_t> const& shown) {
    if (isSaving(mPurpose) || isPath(mField)) return enterTyped();
    if (mSelected < shown.size() && shown[mSelected] < mList.entries.size()) // unless the folder has changed since
        enterEntry(mList.entries[shown[mSelected]]);
}

void FileDialog::walk(std::vector<size_t> const& shown) {
    const size_t before = mSelected, last = shown.empty() ? 0 : shown.size() - 1;
    if (isPressed(ImGuiKey_UpArrow) && mSelected > 0) --mSelected;
    if (isPressed(ImGuiKey_DownArrow)) ++mSelected;
    if (isPressed(ImGuiKey_PageUp)) mSelected -= std::min(mSelected, kRowsOfPage);
    if (isPressed(ImGuiKey_PageDown)) mSelected += kRowsOfPage;
    mSelected = std::min(mSelected, last);
    mHasMoved |= mSelected != before;
}

void FileDialog::drawPlace() {
    if (ImGui::ArrowButton("above", ImGuiDir_Up)) goTo(mFolder.parent_path());
    ImGui::SameLine();
    std::string place = shownName(mFolder.string());
    const auto characters = static_cast<size_t>(ImGui::GetContentRegionAvail().x / ImGui::CalcTextSize("m").x);
    if (characters > 3 && place.size() > characters) // its end says more than its beginning
        place = "..." + shownName(place.substr(place.size() - characters + 3));
    ImGui::TextUnformatted(place.c_str());
}

void FileDialog::drawRecent() {
    if (mPurpose != FilePurpose::Open) return;
    for (size_t i = 0; i < std::min(recent.size(), kShownRecent); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::filesystem::path file = recent[i];
        if (ImGui::Button("open")) choose(file);
        ImGui::SameLine();
        ImGui::TextUnformatted(shownName(file.string()).c_str());
        ImGui::PopID();
    }
    if (!recent.empty()) ImGui::Separator();
}

void FileDialog::drawEntries(std::vector<size_t> const& shown) {
    const float below = ImGui::GetFrameHeightWithSpacing() * 2;
    if (ImGui::BeginChild("entries", { 0, -below }, true)) {
        std::optional<size_t> clicked;
        for (size_t row = 0; row < shown.size(); ++row) {
            FolderEntry const& entry = mList.entries[shown[row]];
            ImGui::PushID(static_cast<int>(row));
            if (ImGui::Selectable("##entry", row == mSelected, ImGuiSelectableFlags_AllowDoubleClick)) {
                mSelected = row;
                if (isSaving(mPurpose) && !entry.isFolder) mField = entry.name, mToReplace.clear();
                if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) clicked = row;
            }
            if (row == mSelected && mHasMoved) ImGui::SetScrollHereY();
            ImGui::SameLine(0, 0);
            ImGui::TextUnformatted((shownName(entry.name) + (entry.isFolder ? "/" : "")).c_str());
            if (!entry.isFolder) {
                ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::GetFontSize() * 5);
                ImGui::TextDisabled("%s", bytesText(entry.bytes).c_str());
            }
            ImGui::PopID();
        }
        mHasMoved = false;
        if (shown.empty())
            ImGui::TextDisabled("%s", isReading()             ? "reading ..."
                                      : !mList.error.empty()  ? mList.error.c_str()
                                      : mList.entries.empty() ? "nothing here that can be opened"
                                                              : "no name has these words");
        if (mList.isCut) ImGui::TextDisabled("more than %zu entries: type a path", kMostEntries);
        if (clicked) enterEntry(mList.entries[shown[*clicked]]);
    }
    ImGui::EndChild();
}

/// Keeps the keyboard, so that keys do not reach the scene. True: its text has changed.
bool FileDialog::drawField(bool hasKeys) {
    if (mIsNew || !ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool goesUp = hasKeys && mField.empty() && isPressed(ImGuiKey_Backspace);
    const bool isChanged =
            ImGui::InputTextWithHint("##field", isSaving(mPurpose) ? "name" : "filter, or a path", &mField);
    if (goesUp) goTo(mFolder.parent_path());
    return isChanged;
}

void FileDialog::drawButtons(std::vector<size_t> const& shown) {
    if (ImGui::Button(isSaving(mPurpose) ? "save" : "open")) enter(shown);
    ImGui::SameLine();
    if (ImGui::Button("cancel")) close();
    if (mToReplace.empty()) return;
    ImGui::SameLine();
    ImGui::Text("%s exists: save again to replace it", shownName(mToReplace.filename().string()).c_str());
}

void FileDialog::draw() {
    pollReading();
    if (!mIsOpen) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float line = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({ display.x / 2, display.y / 2 }, ImGuiCond_Always, { 0.5f, 0.5f });
    ImGui::SetNextWindowSize({ std::min(line * 48, display.x), std::min(line * 36, display.y) });
    if (mIsNew) ImGui::SetNextWindowFocus();
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize;
    bool staysOpen = true;
    if (ImGui::Begin(titleOf(mPurpose), &staysOpen, kFlags)) {
        const std::string filter = isSaving(mPurpose) || isPath(mField) ? "" : mField;
        const std::vector<size_t> shown = matching(mList.entries, filter);
        drawPlace();
        drawRecent();
        const bool hasKeys = ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
        if (hasKeys) walk(shown);
        if (hasKeys && (isPressed(ImGuiKey_Enter) || isPressed(ImGuiKey_KeyPadEnter))) enter(shown);
        if (hasKeys && isPressed(ImGuiKey_Escape)) close();
        drawEntries(mList.entries.empty() ? std::vector<size_t>{} : shown); // enter() may have left the folder
        if (drawField(hasKeys)) mSelected = 0, mToReplace.clear();
        drawButtons(shown);
        mIsNew = false;
    }
    ImGui::End();
    if (!staysOpen) close();
}

} // namespace filament::view
