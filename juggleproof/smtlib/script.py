"""Scripts of SMT-LIB: each `check-sat` becomes a problem with the assertions in force there.

`push` and `pop` open and close a scope of declarations, definitions and assertions; `set-info`
gives the next problem its `:name` and `:status`, and all later problems their `:source`.

Formula: the assertions F1, .., Fn have no solution <=> for all reals: not (F1 and .. and Fn), which
is the statement of the problem. Source: SMT-LIB 2.6, section 4.2.  The logic that a script names is
ignored: the reader takes real arithmetic without quantifiers, and Bools.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from juggleproof.smtlib.sexpr import Expression, Script, SexprList, SexprWord
from juggleproof.smtlib.terms import (
    RESERVED,
    SORTS,
    DefinedFunction,
    Meaning,
    TermReader,
    brief,
)
from juggleproof.smtlib.values import Value, plain
from juggleproof.statements.language import NAME, ClaimError, Formula, Term, real
from juggleproof.statements.language import RESERVED as OUR_RESERVED
from juggleproof.statements.store import plain_file

# commands that only ask for output; they are ignored
IDLE = frozenset(
    {
        "echo",
        "get-model",
        "get-value",
        "get-info",
        "get-option",
        "get-assertions",
        "get-assignment",
        "get-proof",
        "get-unsat-core",
        "get-unsat-assumptions",
    }
)
STATUSES = ("sat", "unsat", "unknown")


# -------------------------------------------------------------------------------------------------
# Names of a script in our language.


def our_name(symbol: str, taken: Collection[str]) -> str:
    """A name for a variable of the script that our language allows and that is not taken.

    >>> our_name("x", []), our_name("x'", ["x_1"]), our_name("lambda", []), our_name("|", [])
    ('x', 'x_', 'lambda_', 'v')
    """
    base = re.sub(r"\W", "_", symbol, flags=re.ASCII).lstrip("_0123456789") or "v"
    name = base if NAME.match(base) and base not in OUR_RESERVED else base + "_"
    count = 1
    while name in taken:
        count += 1
        name = f"{base}_{count}"
    return name


# -------------------------------------------------------------------------------------------------
# Scripts.


@dataclass(frozen=True)
class Variable:
    """A constant of the script: its symbol there, its name in our language, its sort.  A Bool b
    becomes the formula b > 0 for a real b.
    """

    symbol: str
    name: str
    sort: str


@dataclass(frozen=True)
class Problem:
    """The problem of one `check-sat`, the `number`-th of its script: whether all of the assertions
    can hold at once.

    Each assertion has its line; `meanings` has the meanings of the names that parts of assertions
    get (`values.Parts`), and perhaps of others; `status`, `name` and `source` are as the script
    states them, or empty; `commands` are all commands that declare, define and assert it.
    """

    file: str
    line: int
    number: int
    variables: tuple[Variable, ...]
    assertions: tuple[tuple[int, Formula], ...]
    commands: tuple[SexprList, ...]
    meanings: Mapping[str, Term | Formula]
    status: str = ""
    name: str = ""
    source: str = ""

    @property
    def place(self) -> str:
        """File and line, and the name where there is one."""
        return f"{self.file}:{self.line}" + (f" ({self.name})" if self.name else "")

    @property
    def script(self) -> str:
        """A script of this problem alone.

        >>> print(read_problems("(push)(assert false)(pop)(assert true)(check-sat)", "f")[0].script)
        (set-logic QF_NRA)
        (assert true)
        (check-sat)
        """
        return "\n".join(["(set-logic QF_NRA)", *map(str, self.commands), "(check-sat)"])


@dataclass
class ScriptFrame:
    """A scope of a script: declarations, definitions and assertions since a push, and their
    commands.
    """

    symbols: list[str] = field(default_factory=list)
    variables: list[Variable] = field(default_factory=list)
    assertions: list[tuple[int, Formula]] = field(default_factory=list)
    commands: list[SexprList] = field(default_factory=list)


class ScriptSession:
    """A session that reads a script: a stack of frames, and the problems so far."""

    def __init__(self, script: Script) -> None:
        self.script = script
        self.scope: dict[str, Meaning] = {}  # all declared and defined symbols
        self.names: set[str] = set()  # the names of the variables in our language
        self.reader = TermReader(script, lambda: self.names)
        self.frames, self.problems = [ScriptFrame()], list[Problem]()
        self.status, self.name, self.source, self.ended = "", "", "", False
        self.lasting = False  # declarations outlive their (pop)

    @property
    def declared(self) -> ScriptFrame:
        """The frame of new declarations and definitions."""
        return self.frames[0 if self.lasting else -1]

    def execute(self, command: Expression) -> None:
        """Carries out one command."""
        if (
            not isinstance(command, SexprList)
            or not command.items
            or not isinstance(command.items[0], SexprWord)
        ):
            self.script.fail(
                command, f"{brief(command)} is no command", "write commands as (assert ..)"
            )
        name = command.items[0].text
        handler = getattr(self, "_" + name.replace("-", "_"), None) if name in COMMANDS else None
        if handler is None and name not in IDLE:
            self.script.fail(
                command,
                f"{name}: an unknown command",
                "use declare-const, define-fun, assert, check-sat, push, pop, reset",
            )
        if handler is not None:
            least, most = COMMANDS[name]
            if not least <= len(command.items) - 1 <= most:
                self.script.fail(
                    command,
                    f"{name} takes {least if least == most else f'{least} to {most}'} arguments,"
                    f" not {len(command.items) - 1}",
                    "mend the command",
                )
            handler(command, *command.items[1:])
            if name in KEPT:
                frame = self.frames[-1] if name == "assert" else self.declared
                frame.commands.append(command)

    # ------------------------------------------------------------ settings

    def _set_logic(self, command: SexprList, logic: Expression) -> None:
        if not isinstance(logic, SexprWord) or logic.kind != "symbol":
            self.script.fail(logic, f"{brief(logic)} names no logic", "write (set-logic QF_NRA)")

    def _set_info(
        self, command: SexprList, keyword: Expression, value: Expression | None = None
    ) -> None:
        if str(keyword) == ":status":
            if str(value) not in STATUSES:
                self.script.fail(
                    command, f"the status {value} is none", f"write one of {', '.join(STATUSES)}"
                )
            self.status = str(value)
        elif str(keyword) == ":name" and isinstance(value, SexprWord):
            self.name = value.text
        elif str(keyword) == ":source" and isinstance(value, SexprWord):
            self.source = value.text

    def _set_option(
        self, command: SexprList, keyword: Expression, value: Expression | None = None
    ) -> None:
        if str(keyword) == ":global-declarations":
            if str(value) not in ("true", "false"):
                self.script.fail(command, f"{keyword} is true or false", "mend the option")
            self.lasting = str(value) == "true"

    def _exit(self, command: SexprList) -> None:
        self.ended = True

    # ------------------------------------------------------------ declarations

    def _symbol(self, word: Expression) -> str:
        if not isinstance(word, SexprWord) or word.kind != "symbol":
            self.script.fail(word, f"{brief(word)} is no symbol", "name what is declared")
        if word.text in RESERVED or word.text in self.scope:
            self.script.fail(
                word, f"{word.text} is declared already, or is reserved", "choose another name"
            )
        return word.text

    def _sort(self, node: Expression) -> str:
        if str(node) not in SORTS:
            self.script.fail(
                node, f"the sort {brief(node)} is not taken on", f"use {' or '.join(SORTS)}"
            )
        return str(node)

    def _declare_const(self, command: SexprList, word: Expression, sort: Expression) -> None:
        variable = Variable(
            symbol := self._symbol(word),
            our_name(symbol, self.names | self.reader.parts.meanings.keys()),
            self._sort(sort),
        )
        self.declared.variables.append(variable)
        self.names.add(variable.name)
        own = real(variable.name)
        self._define(symbol, plain(own) if variable.sort == "Real" else own > 0)

    def _define(self, symbol: str, meaning: Meaning) -> None:
        self.declared.symbols.append(symbol)
        self.scope[symbol] = meaning

    def _declare_fun(
        self, command: SexprList, word: Expression, parameters: Expression, sort: Expression
    ) -> None:
        if not isinstance(parameters, SexprList) or parameters.items:
            self.script.fail(
                command,
                f"{brief(word)} is declared with parameters: uninterpreted functions are not"
                " taken on",
                "define it by define-fun",
            )
        self._declare_const(command, word, sort)

    def _define_fun(
        self,
        command: SexprList,
        word: Expression,
        parameters: Expression,
        sort: Expression,
        body: Expression,
    ) -> None:
        symbol, sort_name = self._symbol(word), self._sort(sort)
        pairs = self.reader.pairs(parameters, "define-fun name")
        if not isinstance(parameters, SexprList):
            self.script.fail(
                command, f"{brief(parameters)} is no list of parameters", "write ((x Real) ..)"
            )
        scope = {name: self.scope[name] for name in words_of(body) if name in self.scope}
        function = DefinedFunction(
            tuple((name, self._sort(own)) for name, own in pairs), sort_name, body, scope
        )
        # the body is read once with arbitrary arguments, so that an error names the line of the
        # definition
        inner: dict[str, Meaning] = {
            name: plain(real("any")) if own == "Real" else real("any") > 0
            for name, own in function.parameters
        }
        value = self._of_sort(sort_name, body, {**scope, **inner})
        self._define(symbol, function if function.parameters else value)

    def _of_sort(self, sort: str, body: Expression, scope: Mapping[str, Meaning]) -> Value:
        return self.reader.real(body, scope) if sort == "Real" else self.reader.formula(body, scope)

    def _define_const(
        self, command: SexprList, word: Expression, sort: Expression, body: Expression
    ) -> None:
        self._define_fun(command, word, SexprList((), command.line), sort, body)

    # ------------------------------------------------------------ assertions

    def _assert(self, command: SexprList, body: Expression) -> None:
        self.frames[-1].assertions.append((command.line, self.reader.formula(body, self.scope)))

    def _check_sat_assuming(self, command: SexprList, literals: Expression) -> None:
        if not isinstance(literals, SexprList):
            self.script.fail(
                command, f"{brief(literals)} is no list", "write (check-sat-assuming (a (not b)))"
            )
        self._push(command)
        for literal in literals.items:
            self.execute(
                SexprList((SexprWord("assert", "symbol", command.line), literal), command.line)
            )
        self._check_sat(command)
        self._pop(command)

    def _check_sat(self, command: SexprList) -> None:
        variables = tuple(variable for frame in self.frames for variable in frame.variables)
        assertions = tuple(pair for frame in self.frames for pair in frame.assertions)
        self.problems.append(
            Problem(
                self.script.file,
                command.line,
                len(self.problems) + 1,
                variables,
                assertions,
                tuple(command for frame in self.frames for command in frame.commands),
                self.reader.parts.meanings,
                self.status,
                self.name,
                self.source,
            )
        )
        self.status, self.name = "", ""

    def _push(self, command: SexprList, count: Expression | None = None) -> None:
        self.frames += [ScriptFrame() for _ in range(self._levels(command, count))]

    def _pop(self, command: SexprList, count: Expression | None = None) -> None:
        levels = self._levels(command, count)
        if levels >= len(self.frames):
            self.script.fail(command, f"(pop {levels}) without that many (push)", "mend the count")
        kept = len(self.frames) - levels
        self._forget(self.frames[kept:])
        del self.frames[kept:]

    def _forget(self, frames: Sequence[ScriptFrame]) -> None:
        for frame in frames:
            for symbol in frame.symbols:
                del self.scope[symbol]
            self.names -= {variable.name for variable in frame.variables}

    def _levels(self, command: SexprList, count: Expression | None) -> int:
        if count is not None and (
            not isinstance(count, SexprWord) or count.kind != "numeral" or len(count.text) > 3
        ):
            self.script.fail(
                command, f"{brief(count)} is no number of levels", "write a numeral up to 999"
            )
        return 1 if count is None else int(str(count))

    def _reset(self, command: SexprList) -> None:
        self._forget(self.frames)
        self.frames, self.lasting = [ScriptFrame()], False
        self.status, self.name, self.source = "", "", ""

    def _reset_assertions(self, command: SexprList) -> None:
        kept = self.frames[0] if self.lasting else ScriptFrame()
        self._forget(self.frames[int(self.lasting) :])
        kept.assertions = []
        kept.commands = [one for one in kept.commands if str(one.items[0]) != "assert"]
        self.frames = [kept]


def words_of(node: Expression) -> set[str]:
    """The words in an expression."""
    words, left = set[str](), [node]
    while left:
        one = left.pop()
        if isinstance(one, SexprList):
            left += one.items
        else:
            words.add(one.text)
    return words


COMMANDS = {
    "set-logic": (1, 1),
    "set-info": (1, 2),
    "set-option": (1, 2),
    "exit": (0, 0),
    "declare-const": (2, 2),
    "declare-fun": (3, 3),
    "define-fun": (4, 4),
    "define-const": (3, 3),
    "assert": (1, 1),
    "check-sat": (0, 0),
    "check-sat-assuming": (1, 1),
    "push": (0, 1),
    "pop": (0, 1),
    "reset": (0, 0),
    "reset-assertions": (0, 0),
}


KEPT = ("declare-const", "declare-fun", "define-fun", "define-const", "assert")


def read_problems(text: str, file: str) -> list[Problem]:
    """The problems of a script in order, one for each `check-sat`.

    >>> text = "(declare-const x Real)(assert (< (* x x) 0))(check-sat)"
    >>> [one.assertions for one in read_problems(text, "f")]
    [((1, Formula('x*x < 0')),)]

    Raises ClaimError, one line with file and line, where the text is no such script, or has no
    check-sat.
    """
    session = ScriptSession(Script(text, file))
    for command in session.script.expressions():
        if not session.ended:
            session.execute(command)
    if not session.problems:
        session.script.fail(1, "no (check-sat)", "ask what is to be decided")
    return session.problems


def problems_of_file(path: Path) -> list[Problem]:
    """The problems of a file; raises ClaimError, one line, where it cannot be read."""
    if not plain_file(path).exists():
        raise ClaimError(f"{path}: no such file; name a script of SMT-LIB")
    try:
        return read_problems(path.read_text(encoding="utf-8"), str(path))
    except (OSError, UnicodeDecodeError) as error:
        raise ClaimError(
            f"{path}: cannot be read ({type(error).__name__}); name a text file"
        ) from None
