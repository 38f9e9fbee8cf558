"""`python -m rockref`: the command line, where the environment's scripts are not on the path."""

from rockref.cli import main

if __name__ == "__main__":
    main()
