"""The blind test: experiments with sealed hidden effects, made by a simulator that shares no code with the law."""
