"""Forces and design numbers of many designs at once: cycle programs and their gradients."""
