// SPDX-License-Identifier: Apache-2.0
// Branches on constants become branches of the preprocessor, and no others.
#include "shaders/compiler/EsslConditions.h"

#include "shaders/package/EngineMaterials.h"
#include "shaders/package/Package.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace filament_core::shader {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kConstants = "#ifndef SPIRV_CROSS_CONSTANT_ID_3\n"
                                        "#define SPIRV_CROSS_CONSTANT_ID_3 false\n"
                                        "#endif\n"
                                        "const bool hasMap = SPIRV_CROSS_CONSTANT_ID_3;\n"
                                        "const int mode = SPIRV_CROSS_CONSTANT_ID_4;\n"
                                        "const bool _7 = (mode >= 2);\n"
                                        "const bool _8 = (_7 || hasMap);\n"
                                        "const int _9 = _8 ? 1 : 2;\n"
                                        "const bool _10 = (_9 == 1);\n"
                                        "const float size = SPIRV_CROSS_CONSTANT_ID_5;\n";

std::string withConstants(std::string_view code) {
    return preprocessConditions(std::string(kConstants) + std::string(code));
}

TEST(EsslConditions, BecomeThoseOfThePreprocessor) {
    const std::string code =
            "    if (_8)\n    {\n        a();\n    }\n    else\n    {\n        b();\n    }\n    c();\n";
    EXPECT_THAT(withConstants(code),
                HasSubstr("#if (((((SPIRV_CROSS_CONSTANT_ID_4) >= 2)) || (SPIRV_CROSS_CONSTANT_ID_3)))\n"
                          "    {\n        a();\n    }\n#else\n    {\n        b();\n    }\n#endif\n    c();\n"));
    EXPECT_THAT(withConstants("    if (!hasMap)\n    {\n        a();\n    }\n    c();\n"),
                HasSubstr("#if !(SPIRV_CROSS_CONSTANT_ID_3)\n    {\n        a();\n    }\n#endif\n    c();\n"));
    EXPECT_THAT(withConstants("    if (mode == (-1))\n    {\n        a();\n    }\n"),
                HasSubstr("#if (SPIRV_CROSS_CONSTANT_ID_4) == (-1)\n"));
}

TEST(EsslConditions, NestInBranchesOfBothKinds) {
    const std::string code =
            "    if (_7)\n    {\n        if (x > 0.0)\n        {\n            if (hasMap)\n            {\n"
            "                a();\n            }\n        }\n        else\n        {\n            b();\n"
            "        }\n    }\n    else\n    {\n        c();\n    }\n";
    EXPECT_THAT(
            withConstants(code),
            HasSubstr("#if (((SPIRV_CROSS_CONSTANT_ID_4) >= 2))\n    {\n        if (x > 0.0)\n        {\n"
                      "#if (SPIRV_CROSS_CONSTANT_ID_3)\n            {\n                a();\n            }\n#endif\n"
                      "        }\n        else\n        {\n            b();\n        }\n    }\n#else\n    {\n"
                      "        c();\n    }\n#endif\n"));
}

TEST(EsslConditions, StayWhereThePreprocessorCannotDecide) {
    for (const char* condition : { "x > 0.0", "_10", "size > 1.0", "int(size) > 1", "_8 && x", "mode > 5u" }) {
        const std::string code =
                "    if (" + std::string(condition) + ")\n    {\n        a();\n    }\n    else\n    {\n    }\n";
        EXPECT_THAT(withConstants(code), HasSubstr(code)) << condition;
    }
}

TEST(EsslConditions, MakeComparisonsOfBoolDefaults) {
    EXPECT_THAT(withConstants(""), HasSubstr("#define SPIRV_CROSS_CONSTANT_ID_3 (1 == 0)\n"));
    EXPECT_THAT(preprocessConditions("#define SPIRV_CROSS_CONSTANT_ID_3 true\n"),
                HasSubstr("#define SPIRV_CROSS_CONSTANT_ID_3 (1 == 1)\n"));
}

size_t countOf(std::string_view text, std::string_view word) {
    size_t count = 0;
    for (size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

TEST(EsslConditions, AreBalancedInEveryMaterialOfTheEngine) {
    size_t branches = 0;
    for (const std::string_view name : engineMaterialNames()) {
        const auto package = readPackage(engineMaterial(name));
        ASSERT_TRUE(package) << name;
        for (Variant const& variant : package->variants) {
            std::string const& text = variant.fragment->essl;
            EXPECT_EQ(countOf(text, "\n#if"), countOf(text, "\n#endif")) << name;
            EXPECT_THAT(text, Not(HasSubstr("if (variant_"))) << name;
            branches += countOf(text, "\n#if (");
        }
    }
    EXPECT_GT(branches, 1000u);
}

} // namespace
} // namespace filament_core::shader
