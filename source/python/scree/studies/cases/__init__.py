# SPDX-License-Identifier: LGPL-2.1-or-later
"""The studies, a module each."""
