"""The guard of the types' names catches what it is there to catch."""

import unittest

import one_definition


def twice(*texts):
    return [name for name, _ in one_definition.twice(dict(enumerate(texts)))]


class OneDefinitionTest(unittest.TestCase):
    def test_a_class_and_a_struct_of_one_name(self):
        self.assertEqual(twice("namespace a { class Site { int x; }; }", "namespace a { struct Site { int y; }; }"),
                         ["a::Site"])
        self.assertEqual(twice("namespace a::b { enum class E { kOne }; }",
                               "namespace a { namespace b {\nenum E : int { kTwo }; } }"), ["a::b::E"])

    def test_with_bases_alignment_and_templates(self):
        self.assertEqual(twice("class A final : public B<C> { };", "struct alignas(32) A {};"), ["A"])
        self.assertEqual(twice("template <typename T>\nstruct A { };", "template <class T> class A : B { };"), ["A"])

    def test_what_is_in_order(self):
        for one, other in (
            ("namespace a { struct S {}; }", "namespace b { struct S {}; }"),
            ("namespace a { struct S {}; }", "namespace a { namespace { struct S {}; } }"),
            ("struct S {};", "struct S;"),
            ("struct S { struct State {}; };", "struct T { struct State {}; };"),
            ("struct S::State {};", "struct T::State {};"),
            ("struct S { };", "struct S Make() { return {}; } class S* p; // struct S {\n"),
            ("template <> struct S<int> {};", "template <> struct S<long> {};"),
            ("struct S {};", "void F() { struct S { int x; }; }"),
        ):
            self.assertEqual(twice(one, other), [], (one, other))

    def test_nothing_is_cut_off_by_a_text_or_a_macro(self):
        self.assertEqual(twice('const char* t = "{"; struct S {};', "#define X \\\n {\nstruct S {};"), ["S"])


if __name__ == "__main__":
    unittest.main()
