// SPDX-License-Identifier: Apache-2.0
/// FileDialog: chooses a file to open, or a name to save to, in a window of the interface.
///   Keys     typing filters; up and down select; Enter opens the folder or takes the file. While saving, what is typed is
///            the name, and Enter takes it; Backspace in an empty field goes to the folder above; Escape closes. A path that is typed is gone to.
///   Folders  are listed on a thread of their own. Whether one file is there is asked at once.
///   Use      open(), draw() once a frame, takeChosen().
///   Thread   that of ImGui's context. Copies are values: each goes its own way.
///   Life     the last copy waits for folders that are being read.
#pragma once

#include "tools/view/panels/FolderList.h"

#include <filesystem>
#include <future>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament::view {

enum class FilePurpose : uint8_t { Open, OpenPath, SavePath, SavePicture };
bool isSaving(FilePurpose purpose);
/// What the dialog lists for it: lower case, with the dot.
std::span<const std::string_view> endingsOf(FilePurpose purpose);

struct ChosenFile {
    FilePurpose purpose = FilePurpose::Open;
    std::filesystem::path file{}; ///< absolute; of a file that is saved: with one of the endings
};

class FileDialog {
public:
    /// `name`: of the file to save. It begins in the folder that was shown last, or in the current one.
    void open(FilePurpose purpose, std::string name = {});
    void close() { mIsOpen = false; }
    bool isOpen() const { return mIsOpen; }
    void draw();
    std::optional<ChosenFile> takeChosen() { return std::exchange(mChosen, std::nullopt); }

    /// Shown above the folder, newest first.
    std::vector<std::filesystem::path> recent{};

    void goTo(std::filesystem::path const& folder); ///< normalised; what is relative begins in the current folder
    std::filesystem::path const& folder() const { return mFolder; }
    FolderList const& list() const { return mList; }
    bool isReading() const { return mReading.valid(); }

private:
    void pollReading();
    void drawPlace();
    void drawRecent();
    void drawEntries(std::vector<size_t> const& shown);
    bool drawField(bool hasKeys);
    void drawButtons(std::vector<size_t> const& shown);
    void walk(std::vector<size_t> const& shown);
    void enter(std::vector<size_t> const& shown); ///< what is selected or written
    void enterEntry(FolderEntry const& entry);
    void enterTyped();
    void choose(std::filesystem::path const& file);

    FilePurpose mPurpose = FilePurpose::Open;
    bool mIsOpen = false, mIsNew = false;
    std::filesystem::path mFolder{};
    FolderList mList{};
    std::shared_future<FolderList> mReading{};
    std::vector<std::shared_future<FolderList>> mAbandoned{}; ///< until they are finished
    std::string mField{};                                     ///< the filter, or the name
    size_t mSelected = 0;                                     ///< of what is shown
    bool mHasMoved = false;                                   ///< the selection, so that it is scrolled to
    std::filesystem::path mToReplace{};                       ///< exists: saved to if it is chosen again
    std::optional<ChosenFile> mChosen{};
};

} // namespace filament::view
