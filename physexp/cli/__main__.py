"""`python -m physexp.cli` is the command `physexp`."""

from physexp.cli import main

if __name__ == "__main__":
    main()
