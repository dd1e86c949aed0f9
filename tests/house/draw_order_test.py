"""The guard of the draws' order catches what it is there to catch."""

import unittest

import draw_order


def lines(body, header=""):
    return [line for line, _ in draw_order.offences(f"void F(Dice dice, Dice* pot) {{ {body} }}", header)]


class DrawOrderTest(unittest.TestCase):
    def test_two_draws_among_the_arguments_of_a_call(self):
        self.assertEqual(lines("Vector2d at(dice.Unit(), dice.Unit());"), [1])
        self.assertEqual(lines("Put(Between(pot, 0, 1),\n x, pot->Fork());"), [1])
        self.assertEqual(lines("Put(At(Between(&dice, 0, 1)), 2 * PickOf(3, &dice));"), [1])

    def test_a_copy_is_as_good_as_a_draw(self):
        self.assertEqual(lines("Put(dice.Unit(), dice);"), [1])

    def test_the_sides_of_an_operator(self):
        self.assertEqual(lines("x = dice.Unit() + 2 * dice.Unit();"), [1])

    def test_the_line_is_that_of_the_second_draw(self):
        self.assertEqual(lines("\n\nx = dice.Unit()\n - dice.Unit();"), [4])

    def test_within_an_if_a_lambda_and_a_list(self):
        self.assertEqual(lines("if (a) Put(dice.Unit(), dice.Unit());"), [1])
        self.assertEqual(lines("Each([&] { Put(dice.Unit(), dice.Unit()); });"), [1])
        self.assertEqual(lines("V v{F(dice.Unit(), dice.Unit()), 0};"), [1])

    def test_a_member_that_the_header_declares(self):
        header = "class Crowd { CrowdRandom random_; };"
        self.assertEqual(lines("V v(random_.Unit(), random_.Unit());", header), [1])
        self.assertEqual(lines("V v(random_.Unit(), random_.Unit());"), [])

    def test_what_is_in_order_is_allowed(self):
        for body in (
            "const double y = dice.Unit(), x = dice.Unit();",
            "V v{dice.Unit(), dice.Unit()};",
            "Put(x, {dice.Unit(), dice.Unit()});",
            "Put(Between(&dice, 0, 1), &dice); Put(Between(pot, 0, 1), pot);",
            "x = dice.Chance(0.5) ? dice.Unit() : 2 * dice.Unit();",
            "if (dice.Chance(0.5) && dice.Chance(0.5)) x = dice.Unit();",
            "for (int i = dice.Pick(3); i < dice.Pick(3); i += dice.Pick(3)) x = dice.Unit();",
            "x = dice.Between(0, dice.Unit());",
            "Each([&] { x = dice.Unit(); y = dice.Unit(); });",
            "Put(dice.Unit(), pot->Unit());",
            "// Put(dice.Unit(), dice.Unit());",
        ):
            self.assertEqual(lines(body), [], body)


if __name__ == "__main__":
    unittest.main()
