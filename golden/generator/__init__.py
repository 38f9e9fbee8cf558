"""How the vectors are made: questions, exact answers, error bars. Run by `make golden`; needs mpmath (extra `test`)."""
