"""The LaTeX commands that prints and `latex_of` use, and what each is in MathML."""

from __future__ import annotations

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ϵ", "varepsilon": "ε", "eta": "η", "theta": "θ", "kappa": "κ",
    "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ", "phi": "ϕ", "chi": "χ", "psi": "ψ",
    "omega": "ω",
}
UPRIGHT = {  # capitals that TeX sets upright
    "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ", "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω",
    "infty": "∞", "partial": "∂", "emptyset": "∅",
}
OPERATORS = {
    "le": "≤", "leq": "≤", "ge": "≥", "geq": "≥", "ne": "≠", "neq": "≠", "equiv": "≡", "approx": "≈", "lt": "<", "gt": ">", "coloneq": "≔",
    "in": "∈", "notin": "∉", "subset": "⊂", "subseteq": "⊆", "cap": "∩", "cup": "∪", "setminus": "∖",
    "cdot": "⋅", "times": "×", "circ": "∘", "pm": "±", "mid": "∣", "to": "→", "mapsto": "↦", "colon": ":",
    "land": "∧", "lor": "∨", "lnot": "¬", "neg": "¬", "implies": "⟹", "iff": "⟺", "forall": "∀", "exists": "∃", "dots": "…", "ldots": "…",
}
CHARACTERS = {"+": "+", "-": "−", "=": "=", "<": "<", ">": ">", ",": ",", ";": ";", ":": ":", "!": "!", ".": ".", "*": "∗"}
PREFIX = frozenset("+−±")  # signs that are written closer where nothing stands before them
FENCES = {
    "(": "(", ")": ")", "[": "[", "]": "]", "|": "|", r"\{": "{", r"\}": "}", r"\lfloor": "⌊", r"\rfloor": "⌋", r"\lceil": "⌈", r"\rceil": "⌉",
    r"\langle": "⟨", r"\rangle": "⟩", r"\mid": "|", r"\lvert": "|", r"\rvert": "|", ".": "",
}
SPACES = {",": "0.167em", ":": "0.222em", ";": "0.278em", " ": "0.25em", "quad": "1em", "qquad": "2em"}
ACCENTS = {"overline": "‾", "bar": "‾", "dot": "˙", "ddot": "¨", "hat": "^", "tilde": "~", "vec": "→"}
LIMITS = frozenset({"lim", "max", "min", "sup", "inf"})
FUNCTIONS = frozenset({"det", "sin", "cos", "exp", "log", "ln"})
SIZES = frozenset({"big", "Big", "bigl", "bigr", "bigm", "Bigl", "Bigr", "Bigm"})
ALPHABETS = {  # where the letter A would stand in Unicode, and the letters that stand elsewhere
    "mathcal": (0x1D49C, {"B": "ℬ", "E": "ℰ", "F": "ℱ", "H": "ℋ", "I": "ℐ", "L": "ℒ", "M": "ℳ", "R": "ℛ"}),
    "mathbb": (0x1D538, {"C": "ℂ", "H": "ℍ", "N": "ℕ", "P": "ℙ", "Q": "ℚ", "R": "ℝ", "Z": "ℤ"}),
    "mathbf": (0x1D400, {}),
}
MATRICES = {"bmatrix": ("[", "]"), "pmatrix": ("(", ")"), "matrix": ("", ""), "array": ("", ""), "cases": ("{", "")}
LAYERS = frozenset({"split", "aligned", "gathered"})  # environments that only part lines
