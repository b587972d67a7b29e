// SPDX-License-Identifier: Apache-2.0
// The C interface for JavaScript: every type and function that <filament_core.h> declares, by koffi (npm install koffi).
//   load(header, library)  functions by their names without fc_, in camel case: engineCreate(...). One that may fail
//                          throws its error, and returns its last argument.
import { readFileSync } from "node:fs";
import koffi from "koffi";

const camel = (name) => name.replace(/^fc_/, "").replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
const scalars = { "const char*": "str", bool: "bool", int32_t: "int32_t", uint32_t: "uint32_t", uint64_t: "uint64_t",
                  size_t: "size_t", float: "float", double: "double", "const void*": "void *" };

/// Types before functions, each in the order of the header.
function declareTypes(text) {
    const types = { ...scalars };
    const constants = {};
    for (const [, body, name] of text.matchAll(/typedef enum \w+ \{([^}]*)\} (\w+);/g)) {
        types[name] = "int32_t";
        for (const [, value, number] of body.matchAll(/(\w+) = (0x\w+|\d+)/g)) constants[value] = Number(number);
    }
    for (const [, name] of text.matchAll(/typedef struct (\w+) \1;/g)) types[name + "*"] = koffi.pointer(koffi.opaque(name));
    for (const [, body, name] of text.matchAll(/typedef struct \w+ \{([^}]*)\} (\w+);/g)) {
        const members = {};
        for (const [, type, names] of body.matchAll(/(const char ?\*|\w+) ?(\w[^;]*);/g)) {
            for (const member of names.split(", ")) {
                const array = member.match(/(\w+)\[(\d+)\]/);
                const kind = types[type.replace(" *", "*")];
                members[array ? array[1] : member] = array ? koffi.array(kind, Number(array[2])) : kind;
            }
        }
        types[name] = koffi.struct(name, members);
    }
    return { types, constants };
}

function typeOf(types, declaration) {
    const [, isConst, base, stars] = declaration.match(/^(const )?(\w+) ?(\**)/);
    if (base === "char" || (base === "void" && isConst)) return types[`const ${base}*`];
    const kind = stars.startsWith("*") && types[base + "*"] ? types[base + "*"] : types[base];
    const indirect = types[base + "*"] ? stars.length > 1 : stars.length > 0;
    return indirect ? (isConst ? koffi.pointer(kind) : koffi.out(koffi.pointer(kind))) : kind;
}

export function load(header, library) {
    const text = readFileSync(header, "utf8").replace(/\/\*[\s\S]*?\*\//g, "").replace(/\s+/g, " ");
    const { types, constants } = declareTypes(text);
    const native = koffi.load(library);
    const lastError = native.func("fc_last_error", "str", []);
    const api = { ...constants };
    for (const [, result, name, list] of text.matchAll(/(void|const char\*|const void\*|\w+) (fc_\w+)\(([^)]*)\);/g)) {
        const parameters = list === "void" ? [] : list.split(", ").map((parameter) => typeOf(types, parameter));
        const call = native.func(name, result === "void" ? "void" : types[result], parameters);
        const gives = result === "fc_code" && / result$/.test(list);
        const isInit = name.endsWith("_init");
        api[camel(name)] = (...values) => {
            const out = [null];
            const all = gives || isInit ? [...values, isInit ? (out[0] = {}) : out] : values;
            const returned = call(...all);
            if (result === "fc_code" && returned !== 0) throw new Error(lastError());
            return gives || isInit ? out[0] : returned;
        };
    }
    return api;
}
