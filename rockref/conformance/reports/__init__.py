"""The verdict as a person or a machine reads it: terminal, JUnit XML, badge, page."""
