# SPDX-License-Identifier: Apache-2.0
"""What scripts/measure.py is made of: points that are measured once, tables that are made of them, and their records."""
