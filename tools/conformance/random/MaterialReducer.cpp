// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/random/MaterialReducer.h"

#include "tools/conformance/random/Productions.h"

#include <algorithm>
#include <utility>

namespace filament_core::conformance {
namespace {

MaterialTree simplest(std::string const& type) {
    const bool isScalar = componentsOf(type) == 1;
    if (type == "index") return expression(type, "0");
    const char* one = type[0] == 'b' ? "true" : type[0] == 'u' ? "1u" : type[0] == 'i' ? "1" : "0.5";
    return expression(type, isScalar ? one : type + "(" + one + ")");
}

class Reducer {
public:
    Reducer(MaterialTree root, StillFails const& stillFails, size_t tries)
            : mRoot(std::move(root)), mStillFails(stillFails), mLimit(tries) {}

    Reduction run() {
        for (bool changed = true; changed && mTries < mLimit;) {
            const size_t before = sizeOf(mRoot);
            shrink(mRoot);
            changed = sizeOf(mRoot) < before;
        }
        return { std::move(mRoot), mTries };
    }

private:
    bool fails() { return mTries < mLimit && (++mTries, mStillFails(print(mRoot))); }

    bool replace(MaterialTree& tree, MaterialTree other) {
        std::swap(tree, other);
        if (fails()) return true;
        std::swap(tree, other);
        return false;
    }

    void shrink(MaterialTree& tree) {
        if (tree.isList())
            shrinkList(tree);
        else if (tree.isExpression())
            shrinkExpression(tree);
        else
            unwrap(tree);
        for (MaterialTree& child : tree.children) shrink(child);
    }

    void shrinkList(MaterialTree& list) {
        for (size_t length = list.children.size(); length > 0; length /= 2) {
            for (size_t end = list.children.size(); end > 0;) { // from the end: what is used stands before its user
                const size_t begin = end > length ? end - length : 0;
                MaterialTree shorter = list;
                const auto first = shorter.children.begin();
                shorter.children.erase(first + static_cast<std::ptrdiff_t>(begin),
                                       first + static_cast<std::ptrdiff_t>(end));
                replace(list, std::move(shorter));
                end = begin;
            }
        }
    }

    void shrinkExpression(MaterialTree& tree) {
        if (tree.children.empty()) return;
        if (replace(tree, simplest(tree.type))) return;
        for (bool again = true; again;) {
            again = false;
            std::vector<MaterialTree> parts;
            collect(tree, tree.type, parts);
            for (MaterialTree& part : parts) {
                again = replace(tree, std::move(part));
                if (again) break;
            }
        }
    }

    // The parts with this type that are not inside another such part.
    static void collect(MaterialTree const& tree, std::string const& type, std::vector<MaterialTree>& parts) {
        for (MaterialTree const& child : tree.children) {
            if (child.type == type)
                parts.push_back(child);
            else
                collect(child, type, parts);
        }
    }

    // if (a) { b } becomes b.
    void unwrap(MaterialTree& tree) {
        const std::vector<MaterialTree> children = tree.children;
        for (MaterialTree const& child : children) {
            if (child.isList() && child.joint == "\n" && replace(tree, child)) return;
        }
    }

    MaterialTree mRoot;
    StillFails const& mStillFails;
    size_t mLimit, mTries = 0;
};

} // namespace

Reduction reduceMaterial(MaterialTree material, StillFails const& stillFails, size_t tries) {
    return Reducer(std::move(material), stillFails, tries).run();
}

} // namespace filament_core::conformance
