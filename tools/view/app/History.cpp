// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/History.h"

namespace filament_core::view {
namespace {

/// What no step changes. Another model has other animations: with it, its playback comes back.
void keepMoving(Document& document, Document const& current) {
    document.view.camera = current.view.camera;
    document.view.size = current.view.size;
    document.view.timeSeconds = current.view.timeSeconds;
    if (document.model.file == current.model.file) document.playback = current.playback;
}

} // namespace

bool isSameEdit(Document const& a, Document const& b) {
    Document other = b;
    keepMoving(other, a);
    return a == other;
}

void History::note(Document const& document, bool isEditing) {
    if (isEditing || isSameEdit(document, mNow)) return;
    mBefore.push_back(std::exchange(mNow, document));
    if (mBefore.size() > kSteps) mBefore.pop_front();
    mAfter.clear();
}

bool History::go(std::deque<Document>& from, std::deque<Document>& to, Document& now, Document& document) {
    if (from.empty()) return false;
    to.push_back(now);
    now = std::move(from.back());
    from.pop_back();
    Document next = now;
    keepMoving(next, document);
    document = std::move(next);
    return true;
}

bool History::undo(Document& document) {
    note(document, false);
    return go(mBefore, mAfter, mNow, document);
}
bool History::redo(Document& document) {
    note(document, false); // an edit since the last frame is not written over
    return go(mAfter, mBefore, mNow, document);
}

} // namespace filament_core::view
