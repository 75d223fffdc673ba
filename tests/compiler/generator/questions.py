"""Iterations that ask whether tokens are there, or have room, and do nothing where they would have to wait."""

from .ports import Ports


class Questions(Ports):
    def ask(self, asked, outputs, leave):
        """Begins an iteration that does nothing unless all inputs of `asked` have tokens; `leave`: the statement that ends
        it early. Returns the lines that have to stand behind the iteration. The inputs of `asked` are read in every iteration."""
        r = self.r
        if len(asked) == 1 and r.random() < 0.3:
            self.hit("read_nb")
            self.leave_unless_read = (asked[0], leave)
            return []
        questions = [f"{port['name']}.empty()" for port in asked]
        self.hit("question empty")
        if outputs and r.random() < 0.3:
            self.hit("question full")
            questions.append(f"{r.choice(outputs)['name']}.full()")
        r.shuffle(questions)
        style = r.choice(["one", "each", "inside"])
        if style == "inside":
            self.emit(f"if ({' && '.join('!' + q for q in questions)}) {{")
            return ["}"]
        for question in [" || ".join(questions)] if style == "one" else questions:
            self.emit(f"if ({question}) {leave};")
        return []
