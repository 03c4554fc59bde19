"""File formats: pictures, data, workbooks, and a module for each program that reads models."""
