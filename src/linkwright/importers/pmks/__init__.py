"""PMKS and PMKS+: records of texts and of share links, and the bodies they make."""
