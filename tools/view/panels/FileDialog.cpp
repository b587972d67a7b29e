// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/FileDialog.h"

#include "tools/view/panels/PanelText.h"
#include "tools/view/ui/ImGuiVersions.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <array>

namespace filament_core::view {
namespace {

using namespace std::string_view_literals;

constexpr std::array kOpenEndings{ ".gltf"sv, ".glb"sv, ".obj"sv, ".ply"sv,  ".stl"sv,  ".mat"sv,
                                   ".fmat"sv, ".hdr"sv, ".exr"sv, ".ktx2"sv, ".fenv"sv, ".json"sv };
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

bool isPath(std::string const& text) { return text.find('/') != std::string::npos; }

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
    mIsShownCurrent = false;
    mSelected = 0;
    mHasMoved = true;
    mToReplace.clear();
    dropQuestion();
    mAbandoned.add(mReading);
    mReading.emplace([whole, endings = endingsOf(mPurpose)] { return listFolder(whole, endings); });
}

void FileDialog::close() {
    mIsOpen = false;
    dropQuestion();
    mAbandoned.add(mReading); // open() reads again
}

void FileDialog::dropQuestion() { mAbandoned.add(mLooking); }

void FileDialog::poll() {
    mAbandoned.removeFinished();
    if (auto list = takeFinished(mReading)) {
        mList = std::move(*list);
        mIsShownCurrent = false;
    }
    if (const auto typed = takeFinished(mLooking)) follow(*typed);
}

/// A name to save to gets an ending, unless it is a folder.
void FileDialog::lookUp(std::filesystem::path typed) {
    dropQuestion();
    std::filesystem::path file = typed;
    const std::span<const std::string_view> endings = endingsOf(mPurpose);
    if (isSaving(mPurpose) && !endsAsAsked(typed.string(), endings)) file += endings.front();
    mLooking.emplace([typed = std::move(typed), file = std::move(file)] {
        if (kindOfPath(typed) == PathKind::Folder) return Typed{ typed, PathKind::Folder };
        return Typed{ file, kindOfPath(file) };
    });
}

void FileDialog::follow(Typed const& typed) {
    if (typed.kind == PathKind::Folder) {
        mField.clear();
        return goTo(typed.path);
    }
    if (!isSaving(mPurpose)) {
        if (typed.kind == PathKind::File) choose(typed.path);
        return;
    }
    if (typed.kind == PathKind::Missing || typed.path == mToReplace) return choose(typed.path);
    mToReplace = typed.path;
}

void FileDialog::choose(std::filesystem::path const& file) {
    mChosen = ChosenFile{ mPurpose, file };
    close();
}

void FileDialog::enterEntry(FolderEntry const& entry) {
    const std::filesystem::path path = mFolder / entry.name;
    if (entry.isFolder) {
        if (!isSaving(mPurpose)) mField.clear();
        return goTo(path);
    }
    if (isSaving(mPurpose)) return lookUp(path);
    choose(path);
}

void FileDialog::enter() {
    if (isSaving(mPurpose) || isPath(mField)) {
        if (!mField.empty()) lookUp(mFolder / mField); // an absolute path takes the folder's place
        return;
    }
    if (mSelected < mShown.size()) enterEntry(mList.entries[mShown[mSelected]]);
}

void FileDialog::updateShown() {
    std::string filter = isSaving(mPurpose) || isPath(mField) ? "" : mField;
    if (mIsShownCurrent && filter == mShownFilter) return;
    mShownFilter = std::move(filter);
    mShown = matching(mList.entries, mShownFilter);
    mIsShownCurrent = true;
}

void FileDialog::walk() {
    const size_t before = mSelected, last = mShown.empty() ? 0 : mShown.size() - 1;
    if (isKeyPressed(ImGuiKey_UpArrow) && mSelected > 0) --mSelected;
    if (isKeyPressed(ImGuiKey_DownArrow)) ++mSelected;
    if (isKeyPressed(ImGuiKey_PageUp)) mSelected -= std::min(mSelected, kRowsOfPage);
    if (isKeyPressed(ImGuiKey_PageDown)) mSelected += kRowsOfPage;
    mSelected = std::min(mSelected, last);
    mHasMoved |= mSelected != before;
}

void FileDialog::drawOrder() {
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

std::optional<size_t> FileDialog::drawRow(size_t row) {
    FolderEntry const& entry = mList.entries[mShown[row]];
    std::optional<size_t> clicked;
    ImGui::PushID(static_cast<int>(row));
    if (ImGui::Selectable("##entry", row == mSelected, ImGuiSelectableFlags_AllowDoubleClick)) {
        mSelected = row;
        dropQuestion();
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
    return clicked;
}

void FileDialog::drawEntries() {
    const float below = ImGui::GetFrameHeightWithSpacing() * 2;
    std::optional<size_t> clicked;
    if (ImGui::BeginChild("entries", { 0, -below }, true)) {
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(mShown.size()));
        const auto selected = static_cast<int>(mSelected);
        if (mHasMoved && mSelected < mShown.size()) alwaysDraw(clipper, selected);
        while (clipper.Step())
            for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row)
                if (const auto twice = drawRow(static_cast<size_t>(row))) clicked = twice;
        mHasMoved = false;
        if (mShown.empty())
            ImGui::TextDisabled("%s", mReading                ? "reading ..."
                                      : !mList.error.empty()  ? mList.error.c_str()
                                      : mList.entries.empty() ? "nothing here that can be opened"
                                                              : "no name has these words");
        if (mList.isCut) ImGui::TextDisabled("more than %zu entries: type a path", kMostEntries);
    }
    ImGui::EndChild();
    if (clicked) enterEntry(mList.entries[mShown[*clicked]]);
}

/// Keeps the keyboard, so that keys do not reach the scene. True: its text has changed.
bool FileDialog::drawField(bool hasKeys) {
    if (mIsNew || !ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool goesUp = hasKeys && mField.empty() && isKeyPressed(ImGuiKey_Backspace);
    const bool isChanged =
            ImGui::InputTextWithHint("##field", isSaving(mPurpose) ? "name" : "filter, or a path", &mField);
    if (goesUp) goTo(mFolder.parent_path());
    return isChanged;
}

void FileDialog::drawButtons() {
    if (ImGui::Button(isSaving(mPurpose) ? "save" : "open")) enter();
    ImGui::SameLine();
    if (ImGui::Button("cancel")) close();
    if (mToReplace.empty()) return;
    ImGui::SameLine();
    ImGui::Text("%s exists: save again to replace it", shownName(mToReplace.filename().string()).c_str());
}

void FileDialog::draw() {
    poll();
    if (!mIsOpen) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float line = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({ display.x / 2, display.y / 2 }, ImGuiCond_Always, { 0.5f, 0.5f });
    ImGui::SetNextWindowSize({ std::min(line * 48, display.x), std::min(line * 36, display.y) });
    if (mIsNew) ImGui::SetNextWindowFocus();
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize;
    bool staysOpen = true;
    if (ImGui::Begin(titleOf(mPurpose), &staysOpen, kFlags)) {
        drawOrder();
        drawRecent();
        updateShown(); // of the folder that these two may have left
        const bool hasKeys = ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
        if (hasKeys) walk();
        if (hasKeys && (isKeyPressed(ImGuiKey_Enter) || isKeyPressed(kImGuiKeypadEnter))) enter();
        if (hasKeys && isKeyPressed(ImGuiKey_Escape)) close();
        updateShown();
        drawEntries();
        if (drawField(hasKeys)) {
            mSelected = 0;
            mToReplace.clear();
            dropQuestion();
        }
        updateShown();
        drawButtons();
        mIsNew = false;
    }
    ImGui::End();
    if (!staysOpen) close();
}

} // namespace filament_core::view
