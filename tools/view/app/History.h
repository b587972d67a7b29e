// SPDX-License-Identifier: Apache-2.0
/// History: undo and redo of a Document. The camera, the playback and the size of the image are not edits: they stay
/// as they are; the playback only while the model does.
///   Use      note() once a frame: an edit that is over becomes a step.
///   Memory   the last kSteps documents.   Thread: any; a plain value.
#pragma once

#include "tools/view/document/Document.h"

#include <deque>

namespace filament_core::view {

/// Whether they differ in nothing but camera, playback and size.
bool isSameEdit(Document const& a, Document const& b);

class History {
public:
    static constexpr size_t kSteps = 100;

    explicit History(Document const& document) : mNow(document) {}
    /// `isEditing`: something is being dragged, say: steps are not made yet.
    void note(Document const& document, bool isEditing);
    bool undo(Document& document); ///< false: there is nothing
    bool redo(Document& document); ///< false: nothing was undone, or the document was edited since
    size_t undoSteps() const { return mBefore.size(); }

private:
    static bool go(std::deque<Document>& from, std::deque<Document>& to, Document& now, Document& document);

    Document mNow; ///< as of the last step
    std::deque<Document> mBefore, mAfter;
};

} // namespace filament_core::view
