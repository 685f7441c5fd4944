# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measures that several studies share."""
