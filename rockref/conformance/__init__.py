"""The oracle: vectors with computed bars, a judge that names the wrong equation, a zoo of mistakes that proves it.

Ways in: `backend.load(target)`, `executable.Executable(command)`, `offline.Recorded(path)`. Then `judge.judge(backend)`
gives findings, and `verdict.verdict(findings, backend)` says what they mean.
"""
