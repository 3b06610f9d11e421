"""`python -m physexp` is the command `physexp`."""

from physexp.cli import main

if __name__ == "__main__":
    main()
