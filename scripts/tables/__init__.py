# SPDX-License-Identifier: Apache-2.0
"""Declarations of tables, CSV files and pictures of the documents; scripts/measure.py makes them."""
