import sys

from validation import main

sys.exit(main(sys.argv[1:]))
