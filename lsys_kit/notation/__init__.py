"""Text to records and back. Knows nothing of derivations, pictures or files.

The registry is loaded first, so that a system can print itself, in whichever notation it was read.
"""

from lsys_kit.notation import registry as registry
