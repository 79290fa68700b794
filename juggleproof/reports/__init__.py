"""Reports: the regenerated appendix, the theorem with its proof, errata and figures, from the
claims and the derivations.

    tables                 tables as columns, and exact numbers
    tree                   the rules and premises that the theorem rests on
    counterexample_words   counterexamples in words
    errata                 the errors of the paper
    results                the results of a run as rows and data
    contents               the contents of a report, gathered once, and JSON
    latex                  names, terms and formulas as LaTeX
    words                  sentences and statements in words and LaTeX
    mathml                 LaTeX as MathML
    markup                 sentences, statements and the proof tree as markup
    page                   the HTML page
    tex_words              the functions that the LaTeX templates call
    tex                    the LaTeX report and the PDF
    figures                the figures
    part                   the part-orienting scene
    problems               the answers to problems of SMT-LIB
    ci                     the badge, JUnit and Markdown
    pages                  the generated pages of docs
"""
